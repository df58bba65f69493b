#include "plugins/coupling/element_chunks.h"

#include <algorithm>
#include <numeric>

namespace pedicel::coupling {

namespace {

using cosserat::CollisionShape;
using cosserat::RodModel;
using geometry::Aabb;

// Few enough that a box is small beside the plant, and many enough that boxes cost little beside
// shapes. A branch begins a new run, since its way leads away from the stem's.
constexpr int most_elements = 8;
constexpr int least_elements = 4;  // before a chunk may end where another branch begins

// Comparisons that a NaN never wins: an iterate that has run away does not swallow its neighbours.
// From child nodes only, without orientations: that is three comparisons an element and axis.
Aabb box_around(const std::vector<Vec3>& position, int first, int last) {
  constexpr double far = std::numeric_limits<double>::max();
  double low[3] = {far, far, far}, high[3] = {-far, -far, -far};
  for (int e = first; e < last; ++e) {
    for (int axis = 0; axis < 3; ++axis) {
      const double value = position[e][axis];
      low[axis] = value < low[axis] ? value : low[axis];
      high[axis] = value > high[axis] ? value : high[axis];
    }
  }
  return {Vec3(low[0], low[1], low[2]), Vec3(high[0], high[1], high[2])};
}

// A box of nodes widened by `reach`; one without nodes stays empty.
Aabb widened(Aabb box, double reach) {
  box.min().array() -= reach;
  box.max().array() += reach;
  return box;
}

}  // namespace

void ElementChunks::build(const RodModel& model, double margin) {
  // Runs are of neighbours in number. A chain's elements follow each other, so these are neighbours
  // in space as well, and no tree of boxes has to be built.
  elements_ = model.elements.size();
  shapes_.resize(model.shapes.size());
  std::iota(shapes_.begin(), shapes_.end(), 0);
  const auto element_of = [&](int shape) { return model.shapes[shape].element; };
  // Shapes in the order of their elements: a run then has one range of them. Stable, so that
  // contacts are found in the same order in each run.
  std::stable_sort(shapes_.begin(), shapes_.end(),
                   [&](int a, int b) { return element_of(a) < element_of(b); });
  chunks_.clear();
  std::size_t next_shape = 0;
  for (int e = 0; e < model.size(); ++e) {
    const int length = chunks_.empty() ? most_elements : e - chunks_.back().first;
    const bool is_branch = model.elements[e].parent != e - 1;
    if (length >= most_elements || (is_branch && length >= least_elements)) {
      chunks_.emplace_back();
      chunks_.back().first = e;
      chunks_.back().first_shape = static_cast<int>(next_shape);
      chunks_.back().reach = margin;
    }
    Chunk& chunk = chunks_.back();
    chunk.last = e + 1;
    for (; next_shape < shapes_.size() && element_of(shapes_[next_shape]) == e; ++next_shape) {
      const CollisionShape& shape = model.shapes[shapes_[next_shape]];
      // Wherever the element turns, its shape stays within this of its node. That makes a box of
      // nodes enough.
      chunk.reach = std::max({chunk.reach, margin + std::abs(shape.back_near) + shape.radius_near,
                              margin + std::abs(shape.back_far) + shape.radius_far});
    }
    // An element without shapes leaves the range as it is, and a run without any is never looked
    // into.
    chunk.last_shape = static_cast<int>(next_shape);
  }
}

void ElementChunks::begin(const std::vector<Vec3>& position) {
  // Once a step. Iterates only add where they are.
  for (Chunk& chunk : chunks_)
    chunk.start_W = widened(box_around(position, chunk.first, chunk.last), chunk.reach);
}

void ElementChunks::extend(const std::vector<Vec3>& position) {
  box_W_.setEmpty();
  for (Chunk& chunk : chunks_) {
    chunk.way_W = widened(box_around(position, chunk.first, chunk.last), chunk.reach);
    // From the start anew and not from the last iterate: boxes would else grow with each iteration
    // that ran away.
    chunk.way_W.extend(chunk.start_W);
    box_W_.extend(chunk.way_W);
  }
}

}  // namespace pedicel::coupling
