#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/cosserat/lanes/lanes.h"

namespace pedicel::cosserat {

using Mat6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// What one spring adds to one element's block, as the rows take it (lanes.h).
struct ElementBlock {
  std::array<double, block_size> values{};  ///< lower triangle by rows, then the right side

  void add_to(Mat6& diagonal, Vec6& right_side) const {
    int place = 0;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j, ++place) {
        diagonal(i, j) += values[place];
        if (j < i) diagonal(j, i) += values[place];
      }
    for (int i = 0; i < 6; ++i) right_side[i] += values[place++];
  }
};

/// What some springs add. The elements stand by themselves: who hands blocks on does not look at
/// their values, which may lie in other cores' caches.
struct ElementBlocks {
  std::span<const int> elements;  ///< -1: it adds nothing
  std::span<const ElementBlock> values;
};

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
  /// The same as the rows take them. Valid until the next call.
  ElementBlocks packed();

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
  std::vector<int> packed_elements_;
  std::vector<ElementBlock> packed_;
};

inline ElementBlocks DiagonalBlocks::packed() {
  packed_elements_.resize(entries_.size());
  packed_.resize(entries_.size());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    packed_elements_[k] = entries_[k].element;
    auto to = packed_[k].values.begin();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) *to++ = entries_[k].diagonal(i, j);
    for (int i = 0; i < 6; ++i) *to++ = entries_[k].right_side[i];
  }
  return {packed_elements_, packed_};
}

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

}  // namespace pedicel::cosserat
