#include "plugins/plant/leaf_template.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto leaf = plant::parse_leaf_template(fuzz::text_of(data, size), "leaf.yaml", diagnostics);
  fuzz::require_answer(leaf, diagnostics);
  if (!leaf) return 0;
  cosserat::RodModel model;
  std::vector<plant::BladeTriangle> blades;
  plant::grow_leaf(model, -1, Vec3::Zero(), Mat3::Identity(), 0.1, *leaf, 0, blades);
  fuzz::require(model.size() == static_cast<int>(leaf->edges.size()), "an element an edge");
  return 0;
}
