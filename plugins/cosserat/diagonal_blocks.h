#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/frames.h"

namespace pedicel::cosserat {

using Mat6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Blocks of a few elements: what springs and contacts add to the diagonal of the step's system and
/// to its right side. Unknowns of an element: (position, rotation vector), both in W. Does not
/// allocate once warm.
class DiagonalBlocks {
 public:
  struct Entry {
    int element = 0;
    Mat6 diagonal = Mat6::Zero();
    Vec6 right_side = Vec6::Zero();
  };

  explicit DiagonalBlocks(int elements) : place_(elements, -1) {}

  void clear() {
    for (const Entry& entry : entries_) place_[entry.element] = -1;
    entries_.clear();
  }
  /// References hold until the next element is asked for.
  Mat6& diagonal(int element) { return entry(element).diagonal; }
  Vec6& right_side(int element) { return entry(element).right_side; }
  /// In the order in which they were first asked for.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Entry& entry(int element) {
    if (place_[element] < 0) {
      place_[element] = static_cast<int>(entries_.size());
      entries_.push_back({element});
    }
    return entries_[place_[element]];
  }

  std::vector<int> place_;  // of an element in entries_; -1: it has none
  std::vector<Entry> entries_;
};

/// Adds a spring of symmetric stiffness `hessian` (N/m, W) that pulls with `force` (N, W) on a
/// point fixed to an element, at `arm` (m, W) from its child node. `Blocks` is anything with
/// diagonal() and right_side().
template <class Blocks>
void add_point_spring(Blocks& blocks, int element, const Vec3& arm, const Mat3& hessian,
                      const Vec3& force) {
  const Mat3 lever = -skew(arm);  // d point / d rotation
  const Mat3 mixed = hessian * lever;
  Mat6& block = blocks.diagonal(element);
  block.template topLeftCorner<3, 3>() += hessian;
  block.template topRightCorner<3, 3>() += mixed;
  block.template bottomLeftCorner<3, 3>() += mixed.transpose();
  block.template bottomRightCorner<3, 3>() += lever.transpose() * mixed;
  Vec6& right = blocks.right_side(element);
  right.template head<3>() += force;
  right.template tail<3>() += arm.cross(force);
}

/// The same for a stiffness `along` the unit vector `axis` and another one `across` it (N/m):
///   hessian = across I + (along - across) axis axis^T
template <class Blocks>
void add_point_spring(Blocks& blocks, int element, const Vec3& arm, const Vec3& axis, double along,
                      double across, const Vec3& force) {
  Vec6 one;  // d (axis . point) / d (position, rotation)
  one << axis, arm.cross(axis);
  Mat6& block = blocks.diagonal(element);
  block += ((along - across) * one) * one.transpose();
  if (across != 0.0) {
    const Mat3 lever = -skew(arm);
    block.template topLeftCorner<3, 3>().diagonal().array() += across;
    block.template topRightCorner<3, 3>() += across * lever;
    block.template bottomLeftCorner<3, 3>() -= across * lever;
    block.template bottomRightCorner<3, 3>() -= (across * arm) * arm.transpose();
    block.template bottomRightCorner<3, 3>().diagonal().array() += across * arm.squaredNorm();
  }
  Vec6& right = blocks.right_side(element);
  right.template head<3>() += force;
  right.template tail<3>() += arm.cross(force);
}

}  // namespace pedicel::cosserat
