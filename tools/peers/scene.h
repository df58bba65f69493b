#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

/// The work on which Pedicel and its peers are measured: E 2e7 Pa, nu 0.3, 450 kg/m3, elements of
/// 2 cm, clamped roots. Pedicel has the same plants in plant/reference_plants.h; the two are
/// written apart so that one checks the other. SI units; W is the world, z up.
namespace peers {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// One rigid segment. Its frame E has its origin at the near end and its third axis along it.
struct Element {
  int parent = -1;                          ///< it starts at this one's far end; -1: it is clamped
  double length = 0.0, radius = 0.0;        ///< m
  Vector3d start = Vector3d::Zero();        ///< m, W, near end as drawn
  Matrix3d frame = Matrix3d::Identity();    ///< E to W as drawn
  double mass = 0.0;                        ///< kg, centre in the middle
  Vector3d inertia = Vector3d::Zero();      ///< kg m2, about the centre, axes of E
  Vector3d stiffness = Vector3d::Zero();    ///< N m/rad of the joint at the near end, axes of E
  Vector3d start_P = Vector3d::Zero();      ///< m, near end in the parent's E (W for a root)
  Matrix3d frame_P = Matrix3d::Identity();  ///< E to the parent's E at rest (to W for a root)
  bool is_end = true;                       ///< nothing grows from it

  Vector3d end() const { return start + length * frame.col(2); }
};

/// A parent stands before its children.
using Plant = std::vector<Element>;

/// 38 upright plants of 59 elements. Settled droop, mean over the 228 ends: -4.62 mm.
std::vector<Plant> forest();

/// One plant of 2,242 elements that hangs from its root, up to 92 joints deep.
std::vector<Plant> tree();

/// A horizontal rod of 0.4 m, r 3 mm, along x.
std::vector<Plant> cantilever(int elements);

}  // namespace peers
