#include "tests/discrepancy/reference_section.h"

#include <cmath>

namespace pedicel::reference {

namespace {

// Area, second moments about axes 1 and 2, torsion constant.
struct Shape {
  double area, i1, i2, torsion;
};

Shape ellipse(double half1, double half2) {
  const double a3 = half1 * half1 * half1, b3 = half2 * half2 * half2;
  return {M_PI * half1 * half2, M_PI * half1 * b3 / 4, M_PI * a3 * half2 / 4,
          M_PI * a3 * b3 / (half1 * half1 + half2 * half2)};
}

Shape rectangle(double width, double height) {
  const double t = height / width;
  return {width * height, height * width * width * width / 12,
          width * height * height * height / 12,
          width * height * height * height * (1.0 / 3 - 0.21 * t * (1 - t * t * t * t / 12))};
}

}  // namespace

SectionValues section_values(const plant::SectionShape& shape, double radius, double youngs_modulus,
                             double poisson_ratio, double density) {
  const Shape s = shape.kind == plant::SectionKind::rectangle
                      ? rectangle(shape.width, shape.height)
                      : ellipse(radius * shape.ratio, radius);
  SectionValues v;
  v.bend1 = youngs_modulus * s.i1;
  v.bend2 = youngs_modulus * s.i2;
  v.twist = youngs_modulus / (2 * (1 + poisson_ratio)) * s.torsion;
  v.stretch = youngs_modulus * s.area;
  v.mass = density * s.area;
  v.inertia1 = density * s.i1;
  v.inertia2 = density * s.i2;
  return v;
}

Quat frame_along(const Vec3& along, const Vec3& normal, const Quat& before) {
  if (normal.isZero()) {
    const Quat turn = Quat::FromTwoVectors(before * Vec3::UnitZ(), along);
    return (turn * before).normalized();
  }
  Mat3 frame;
  frame.col(2) = along;
  frame.col(0) = (normal - normal.dot(along) * along).normalized();
  frame.col(1) = along.cross(frame.col(0));
  return Quat(frame);
}

}  // namespace pedicel::reference
