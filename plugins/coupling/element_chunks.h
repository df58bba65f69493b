#pragma once

#include <vector>

#include "engine/geometry/aabb.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::coupling {

/// The coarse half of the broad phase: a plant cut into runs of some ten neighbouring elements, and
/// a box around the way of each run through a step. The boxes are those of the child nodes, widened
/// by the farthest that a shape of the run reaches from its node, so they hold however the elements
/// turn and cost a few comparisons an element. Does not allocate once built.
class ElementChunks {
 public:
  struct Chunk {
    int first = 0, last = 0;              ///< elements, `last` excluded
    int first_shape = 0, last_shape = 0;  ///< places in shapes(), `last_shape` excluded
    double reach = 0.0;                   ///< m, from a child node to the farthest place of a shape
    geometry::Aabb start_W, way_W;        ///< m; around start and way, `reach` and margin included
  };

  /// The model must be finished. `margin` (m) is added to every box.
  void build(const cosserat::RodModel& model, double margin);
  bool is_built_for(const cosserat::RodModel& model) const {
    return elements_ == model.elements.size() && shapes_.size() == model.shapes.size();
  }

  /// A step begins: the ways start here.
  void begin(const std::vector<Vec3>& position);
  /// Draws every way from the start to here.
  void extend(const std::vector<Vec3>& position);

  const std::vector<Chunk>& chunks() const { return chunks_; }
  /// Indices into RodModel::shapes, in the order of their elements.
  const std::vector<int>& shapes() const { return shapes_; }
  /// m, W, around all ways.
  const geometry::Aabb& box_W() const { return box_W_; }

 private:
  std::vector<Chunk> chunks_;
  std::vector<int> shapes_;
  std::size_t elements_ = 0;
  geometry::Aabb box_W_;
};

}  // namespace pedicel::coupling
