#include "plugins/plant/plant_builder.h"

#include <algorithm>
#include <cmath>

#include "engine/core/stop.h"
#include "engine/io/csv.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/detachment.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/effects/registry/model_change.h"
#include "plugins/plant/plant_size.h"

namespace pedicel::plant {

namespace {

/// A support holds its point this many times stiffer than the segment that it holds is along its
/// axis: it gives way by micrometres under the plant's weight.
constexpr double support_stiffness = 100.0;

// What a file says of a stalk, and what breaks it, are one list.
static_assert(std::ranges::equal(detach_keys, cosserat::stalk_limits, {},
                                 &PlantKey<DetachLimits>::name, &cosserat::StalkLimit::name));

cosserat::Material material_of(const PlantFile& plant, const PlantCurve& curve) {
  const auto value = [&](std::optional<double> MaterialValues::*member) {
    const auto& own = curve.material.*member;
    return own ? *own : (plant.material.*member).value();
  };
  return {value(&MaterialValues::youngs_modulus), value(&MaterialValues::poisson_ratio),
          value(&MaterialValues::density), value(&MaterialValues::damping_time)};
}

// `normal` is the direction of the smaller extent and becomes axis 1.
cosserat::Section section_of(const PlantCurve& curve, double radius,
                             const cosserat::Material& material) {
  switch (curve.section.kind) {
    case SectionKind::rectangle:
      return cosserat::rectangle_section(curve.section.height, curve.section.width, material);
    case SectionKind::ellipse:
      return cosserat::ellipse_section(radius * curve.section.ratio, radius, material);
    case SectionKind::circle:
      break;
  }
  return cosserat::circle_section(radius, material);
}

class Builder {
 public:
  Builder(const PlantFile& plant, const BuildOptions& options, Diagnostics& diagnostics)
      : plant_(plant), options_(options), diagnostics_(diagnostics), curves_(make_curves(plant)) {}

  std::optional<BuiltPlant> run() {
    std::optional<PlantGraph> graph = connect(plant_, curves_, diagnostics_, options_.junction);
    if (!graph) return std::nullopt;
    graph_ = std::move(*graph);
    simplify(graph_, plant_.distance);
    add_stems();
    add_masses();
    add_fruits();
    add_leaves();
    add_supports();
    if (diagnostics_.has_errors()) return std::nullopt;
    cosserat::finish(built_.model);
    stand();
    if (!diagnostics_.has_errors())
      effects::apply_effects(plant_, plant_.effects, built_.model, built_, diagnostics_);
    if (diagnostics_.has_errors()) return std::nullopt;
    if (cosserat::is_hung(built_.model)) hang();
    if (diagnostics_.has_errors()) return std::nullopt;
    return std::move(built_);
  }

 private:
  // Finds the shape in which what relaxes has hung for long.
  void hang() {
    cosserat::RodState state = cosserat::drawn_state(built_.model);
    const cosserat::RodModel relaxed = cosserat::relaxed_for_long(built_.model);
    if (cosserat::settle(relaxed, state, options_.gravity).errors != cosserat::none)
      diagnostics_.error(plant_.where, "plant \"" + plant_.name +
                                           "\" finds no rest once it has relaxed, expected a "
                                           "smaller fraction of what starts hung");
    cosserat::keep_hung_shape(built_.model, state);
  }

  void add_stems() {
    cosserat::RodModel& model = built_.model;
    model.name = plant_.name;
    for (const PlantCurve& curve : plant_.curves)
      model.organs.push_back(plant_.name + "/" + curve.name);
    place_root();
    element_of_.assign(graph_.nodes.size(), -1);
    for (std::size_t n = 1; n < graph_.nodes.size(); ++n)
      if (graph_.nodes[n].kept) add_segment(static_cast<int>(n));
    built_.nodes_sampled = static_cast<int>(graph_.nodes.size());
    built_.nodes_kept = model.size() + 1;
    built_.length_kept = graph_.kept_length();
    for (const geometry::Curve& curve : curves_) {
      built_.curve_lengths.push_back(curve.length());
      built_.length_drawn += curve.length();
    }
  }

  void place_root() {
    const GraphNode& root = graph_.nodes.front();
    const geometry::Curve& curve = curves_[root.curve];
    const bool reversed = root.arc > 0.5 * curve.length();
    const Vec3 along = (reversed ? -1.0 : 1.0) * curve.tangent(root.arc);
    built_.model.root = {options_.pose * root.position,
                         cosserat::least_rotation(Vec3::UnitZ(), options_.pose.rotation * along)};
  }

  void add_segment(int node_index) {
    throw_if_stopped();
    const GraphNode& node = graph_.nodes[node_index];
    const int parent_node = graph_.kept_parent(node_index);
    const GraphNode& parent = graph_.nodes[parent_node];
    const PlantCurve& curve = plant_.curves[node.curve];
    const geometry::Curve& drawn = curves_[node.curve];
    // A curve's first segment also bridges the gap to the node that it is joined to.
    const double near = parent.curve == node.curve ? parent.arc : graph_.start_arc[node.curve];
    const cosserat::Material material = material_of(plant_, curve);
    const cosserat::Section section =
        section_of(curve, drawn.radius(0.5 * (near + node.arc)), material);
    const int e =
        cosserat::add_element(built_.model, element_of_[parent_node], options_.pose * node.position,
                              section, options_.pose.rotation * curve.section.normal);
    cosserat::Element& element = built_.model.elements[e];
    element.damping_time = material.damping_time;
    element.radius_near = drawn.radius(near);
    element.radius_far = drawn.radius(node.arc);
    element.organ = node.curve;
    element_of_[node_index] = e;
    built_.spans.push_back({e, node.curve, near, node.arc, element.length});
  }

  void add_masses() {
    for (const PlantMass& mass : plant_.masses) {
      const PlacedPoint place = locate(mass.place);
      built_.model.masses.push_back({place.element, place.back, mass.mass, 0.0});
    }
  }

  void add_fruits() {
    for (const PlantFruit& given : plant_.fruits) {
      const PlacedPoint place = locate(given.place);
      cosserat::Fruit fruit;
      fruit.name = given.name;
      fruit.element = place.element;
      fruit.back = place.back;
      fruit.radius = given.radius;
      fruit.density = given.density;
      for (std::size_t i = 0; i < cosserat::stalk_limits.size(); ++i)
        if (const auto limit = number_of(given.detach, detach_keys[i]))
          fruit.thresholds.*cosserat::stalk_limits[i].threshold = *limit;
      built_.model.fruits.push_back(std::move(fruit));
    }
  }

  void add_leaves() {
    int number = 0;
    for (const PlantLeaf& leaf : plant_.leaves) {
      throw_if_stopped();
      auto file = find_leaf_template(leaf.leaf_template, plant_.leaf_folders);
      if (!file) file = find_leaf_template(leaf.leaf_template, options_.leaf_folders);
      if (!file) {
        diagnostics_.error(leaf.where,
                           "leaf \"" + leaf.name + "\": no file " + leaf.leaf_template +
                               ".leaf.yaml, expected one in assets/leaves or beside the plant");
        continue;
      }
      if (const auto shape = read_leaf_template(*file, diagnostics_))
        add_leaf(leaf, *shape, number++);
    }
  }

  void add_leaf(const PlantLeaf& leaf, const LeafTemplate& shape, int number) {
    const int curve = plant_.curve_index(leaf.place.curve);
    const double arc = leaf.place.at * curves_[curve].length();
    const Mat3 axes = options_.pose.rotation.toRotationMatrix() *
                      leaf_frame(leaf.normal, leaf.direction, curves_[curve].tangent(arc), number);
    // The place is a node of its own (PlantGraph::carries), so this is exact.
    const PlacedPoint place = locate(leaf.place);
    const bool at_start = place.back > 0.5 * built_.model.elements[place.element].length;
    const int parent = at_start ? built_.model.elements[place.element].parent : place.element;
    built_.model.organs.push_back(plant_.name + "/" + leaf.name);
    grow_leaf(built_.model, parent, options_.pose * curves_[curve].point(arc), axes, leaf.size,
              shape, static_cast<int>(built_.model.organs.size()) - 1, built_.blades);
  }

  void add_supports() {
    for (const CurvePlace& given : plant_.supports) {
      const PlacedPoint place = locate(given);
      const cosserat::Element& element = built_.model.elements[place.element];
      const double share = place.back / element.length;
      cosserat::Support support;
      support.element = place.element;
      support.back = place.back;
      support.position =
          (1.0 - share) * element.drawn_position + share * built_.model.drawn_start(place.element);
      support.position_stiffness = support_stiffness * element.section.axial / element.length;
      support.rotation_stiffness =
          2.0 / element.length *
          Vec3(element.section.bend1, element.section.bend2, element.section.twist);
      built_.model.supports.push_back(support);
    }
  }

  void stand() {
    if (plant_.shape == Shape::rest) return;
    cosserat::RodModel& model = built_.model;
    const cosserat::RodModel drawn = model;
    const cosserat::Standing standing = cosserat::stand_as_drawn(model, options_.gravity);
    if (!standing.solvable) {
      diagnostics_.error(
          plant_.where, "plant \"" + plant_.name + "\" cannot stand as drawn: " +
                            model.organs[model.elements[standing.element].organ] +
                            " is too soft for its load, expected stiffer material, more radius, or "
                            "shape: rest" +
                            size_doubt(plant_));
      return;
    }
    if (!cosserat::is_stable(model, cosserat::drawn_state(model), options_.gravity))
      diagnostics_.warning(
          plant_.where,
          "plant \"" + plant_.name +
              "\" stands as drawn but is unstable: it is beyond its buckling load and "
              "falls over at a touch");
    built_.residual = cosserat::settled_from(drawn, model, options_.gravity);
  }

  PlacedPoint locate(const CurvePlace& place) const {
    return built_.locate(plant_.curve_index(place.curve), place.at);
  }

  const PlantFile& plant_;
  const BuildOptions& options_;
  Diagnostics& diagnostics_;
  std::vector<geometry::Curve> curves_;
  PlantGraph graph_;
  std::vector<int> element_of_;  // one entry a node of the graph; -1: the root, or not kept
  BuiltPlant built_;
};

}  // namespace

std::string residual_text(const BuiltPlant& plant) {
  if (!plant.residual) return {};
  const auto millimetres = [](double metres) {
    return io::format_number(1.0e3 * metres, 2) + " mm";
  };
  const cosserat::RodModel& model = plant.model;
  const int e = plant.residual->element;
  return std::string(plant.residual->settled ? "settles " : "does not settle: it is at least ") +
         millimetres(plant.residual->largest) + " from its drawing" +
         (e < 0 ? "" : " at " + model.organs[model.elements[e].organ]) + ", " +
         millimetres(plant.residual->rms) + " rms";
}

std::optional<BuiltPlant> build_plant(const PlantFile& plant, const BuildOptions& options,
                                      Diagnostics& diagnostics) {
  return Builder(plant, options, diagnostics).run();
}

}  // namespace pedicel::plant
