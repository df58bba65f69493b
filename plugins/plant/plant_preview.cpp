#include "plugins/plant/plant_preview.h"

#include "engine/core/check.h"
#include "plugins/plant/plant_graph.h"
#include "plugins/plant/stem_tree.h"

namespace pedicel::plant {

namespace {

void add_nodes(const PlantGraph& graph, PlantPreview& shown) {
  std::vector<int> index(graph.nodes.size(), -1);
  shown.sampled = static_cast<int>(graph.nodes.size());
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    const GraphNode& node = graph.nodes[n];
    if (!node.kept) continue;
    index[n] = static_cast<int>(shown.nodes.size());
    const int parent = graph.kept_parent(static_cast<int>(n));
    shown.nodes.push_back(
        {node.position, parent < 0 ? -1 : index[parent], node.curve, node.is_key()});
  }
}

}  // namespace

PlantPreview preview(const PlantFile& plant) {
  PlantPreview shown;
  for (const PlantCurve& curve : plant.curves) shown.names.push_back(curve.name);
  try {
    Diagnostics diagnostics;
    const std::vector<StemJoint> tree = stem_tree(plant);
    for (std::size_t c = 0; c < tree.size(); ++c)
      if (!tree[c].joined) shown.loose.push_back(static_cast<int>(c));
    if (check_plant(plant, diagnostics)) {
      if (auto graph = connect(plant, make_curves(plant), diagnostics)) {
        simplify(*graph, plant.distance);
        add_nodes(*graph, shown);
      }
    }
    shown.problem = diagnostics.has_errors() ? diagnostics.text() : "";
  } catch (const UsageError& fault) {
    shown.problem = fault.what();
  }
  return shown;
}

}  // namespace pedicel::plant
