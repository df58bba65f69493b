#include "plugins/cosserat/model/section.h"

#include <algorithm>
#include <cmath>

namespace pedicel::cosserat {

namespace {

constexpr double pi = 3.14159265358979323846;

struct Geometry {
  double area, i1, i2, torsion, shear1, shear2;  // second moments about axes 1, 2; shear factors
};

Section with_material(const Geometry& g, const Material& m) {
  const double shear_modulus = m.youngs_modulus / (2.0 * (1.0 + m.poisson_ratio));
  Section s;
  s.shear1 = g.shear1 * shear_modulus * g.area;
  s.shear2 = g.shear2 * shear_modulus * g.area;
  s.axial = m.youngs_modulus * g.area;
  s.bend1 = m.youngs_modulus * g.i1;
  s.bend2 = m.youngs_modulus * g.i2;
  s.twist = shear_modulus * g.torsion;
  s.mass = m.density * g.area;
  s.inertia1 = m.density * g.i1;
  s.inertia2 = m.density * g.i2;
  s.inertia3 = m.density * (g.i1 + g.i2);
  return s;
}

// Cowper's ellipse, shear along the half-axis `a`; for a = b the circle's 6 (1 + nu) / (7 + 6 nu).
double ellipse_shear(double a, double b, double nu) {
  const double n2 = (a / b) * (a / b);
  return 12.0 * (1.0 + nu) * n2 * (3.0 * n2 + 1.0) /
         ((40.0 + 37.0 * nu) * n2 * n2 + (16.0 + 10.0 * nu) * n2 + nu);
}

// Saint-Venant torsion of a rectangle as the series over odd n.
double rectangle_torsion(double extent1, double extent2) {
  const double w = std::max(extent1, extent2), h = std::min(extent1, extent2);
  double sum = 0.0;
  for (int n = 1; n < 40; n += 2)
    sum += std::tanh(n * pi * w / (2.0 * h)) / std::pow(static_cast<double>(n), 5);
  return w * h * h * h / 3.0 * (1.0 - 192.0 / std::pow(pi, 5) * h / w * sum);
}

}  // namespace

Section circle_section(double radius, const Material& material) {
  return ellipse_section(radius, radius, material);
}

Section ellipse_section(double half1, double half2, const Material& material) {
  const double area = pi * half1 * half2;
  Geometry g{};
  g.area = area;
  g.i1 = area * half2 * half2 / 4.0;
  g.i2 = area * half1 * half1 / 4.0;
  g.torsion = pi * std::pow(half1 * half2, 3) / (half1 * half1 + half2 * half2);
  g.shear1 = ellipse_shear(half1, half2, material.poisson_ratio);
  g.shear2 = ellipse_shear(half2, half1, material.poisson_ratio);
  return with_material(g, material);
}

Section rectangle_section(double extent1, double extent2, const Material& material) {
  const double nu = material.poisson_ratio;
  Geometry g{};
  g.area = extent1 * extent2;
  g.i1 = g.area * extent2 * extent2 / 12.0;
  g.i2 = g.area * extent1 * extent1 / 12.0;
  g.torsion = rectangle_torsion(extent1, extent2);
  g.shear1 = g.shear2 = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
  return with_material(g, material);
}

}  // namespace pedicel::cosserat
