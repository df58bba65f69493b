#include "scene.h"

#include <cmath>

namespace peers {

namespace {

constexpr double youngs_modulus = 2.0e7;       // Pa
constexpr double shear_modulus = 2.0e7 / 2.6;  // Pa, nu 0.3
constexpr double density = 450.0;              // kg/m3
constexpr double golden_angle = 2.399963;      // rad
constexpr double pi = 3.14159265358979323846;

// Compliance of half a segment about its own axes: bent, bent, twisted.
Vector3d half_compliance(const Element& e) {
  const double moment = pi * std::pow(e.radius, 4) / 4.0;  // m4
  const double bent = 0.5 * e.length / (youngs_modulus * moment);
  return {bent, bent, 0.5 * e.length / (shear_modulus * 2.0 * moment)};
}

void add(Plant& plant, int parent, const Vector3d& start, const Vector3d& direction, double length,
         double radius) {
  Element e;
  e.parent = parent;
  e.length = length;
  e.radius = radius;
  e.start = start;
  Vector3d compliance = half_compliance(e);
  if (parent < 0) {
    e.frame = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), direction).toRotationMatrix();
    e.frame_P = e.frame;
    e.start_P = start;
  } else {
    Element& before = plant[parent];
    before.is_end = false;
    e.frame = Eigen::Quaterniond::FromTwoVectors(before.frame.col(2), direction) * before.frame;
    e.frame_P = before.frame.transpose() * e.frame;
    e.start_P = before.length * Vector3d::UnitZ();
    compliance += half_compliance(before);
  }
  e.stiffness = compliance.cwiseInverse();
  e.mass = density * pi * radius * radius * length;
  const double across = e.mass * (radius * radius / 4.0 + length * length / 12.0);
  e.inertia = {across, across, e.mass * radius * radius / 2.0};
  plant.push_back(e);
}

// A straight run of elements of 2 cm after `parent`; returns the index of its first element.
int add_run(Plant& plant, int parent, const Vector3d& root, const Vector3d& direction, int count,
            double radius_first, double radius_last) {
  const int first = static_cast<int>(plant.size());
  for (int k = 0; k < count; ++k) {
    const double radius = radius_first + (radius_last - radius_first) * k / (count - 1.0);
    add(plant, parent, parent < 0 ? root : plant[parent].end(), direction, 0.02, radius);
    parent = first + k;
  }
  return first;
}

// At an angle from the upward (up = 1) or downward (-1) vertical.
Vector3d slanted(double angle, double azimuth, double up) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
          up * std::cos(angle)};
}

}  // namespace

std::vector<Plant> forest() {
  std::vector<Plant> plants(38);
  for (int p = 0; p < 38; ++p) {
    const Vector3d root(0.5 * (p % 7), 0.5 * (p / 7), 0.0);
    add_run(plants[p], -1, root, Vector3d(0.02, 0, 1).normalized(), 19, 0.005, 0.004);
    for (int b = 0; b < 5; ++b)
      add_run(plants[p], 4 + 3 * b, root, slanted(1.0, golden_angle * b + p, 1.0), 8, 0.003, 0.002);
  }
  return plants;
}

std::vector<Plant> tree() {
  Plant plant;
  const Vector3d root = Vector3d::Zero();
  add_run(plant, -1, root, -Vector3d::UnitZ(), 42, 0.005, 0.005);
  for (int b = 0; b < 22; ++b) {
    const double azimuth = golden_angle * b;
    const int node = 1 + static_cast<int>(40.0 * (b + 0.5) / 22.0);
    const int branch = add_run(plant, node, root, slanted(1.0, azimuth, -1.0), 40, 0.004, 0.003);
    for (int k = 0; k < 6; ++k)
      add_run(plant, branch + 5 + 6 * k, root,
              slanted(1.3, azimuth + (k % 2 == 0 ? 0.9 : -0.9), -1.0), 10, 0.002, 0.002);
  }
  return {plant};
}

std::vector<Plant> cantilever(int elements) {
  Plant plant;
  const double length = 0.4 / elements;
  for (int e = 0; e < elements; ++e)
    add(plant, e - 1, Vector3d(e * length, 0, 0), Vector3d::UnitX(), length, 0.003);
  return {plant};
}

}  // namespace peers
