#include "plant/apply_laws.h"

#include <algorithm>
#include <array>

namespace pedicel::plant {

namespace {

using cosserat::Element;
using cosserat::JointLaw;
using cosserat::RodModel;
using cosserat::SegmentAir;

// The length that a joint's bend is spread over: half of each segment that it lies between, or half
// of the first at a clamp.
double joint_length(const RodModel& model, int e) {
  const Element& element = model.elements[e];
  return 0.5 * element.length +
         (element.parent < 0 ? 0.0 : 0.5 * model.elements[element.parent].length);
}

double softer_bending(const RodModel& model, int e) {
  const Vec3& k = model.elements[e].bend_stiffness;
  return std::min(k.x(), k.y());
}

Vec3 vector(const Effect& effect, const char* parameter) {
  const std::vector<double>& v = effect.numbers.at(parameter);
  return {v[0], v[1], v[2]};
}

template <class Task>
void each_element(const PlantFile& plant, const Effect& effect, const BuiltPlant& built,
                  const Task& task) {
  for (const BuiltPlant::Span& span : built.spans)
    if (!effect.place || plant.curve_index(effect.place->curve) == span.curve) task(span.element);
}

bool starts_unloaded(const Effect& effect) {
  const auto start = effect.words.find("start");
  return start != effect.words.end() && start->second == "unloaded";
}

void add_to_joint(const RodModel& model, const Effect& effect, int e, JointLaw& law) {
  const std::string& name = effect.name;
  const double length = joint_length(model, e);
  if (name == "material_nonlinearity") {
    const double bend = effect.number("k0") * length;
    law.hardening += effect.number("coefficient") / (bend * bend);
  }
  if (name == "structural_damping") {
    const double frequency =
        effect.numbers.contains("frequency") ? effect.number("frequency") : 2.0;
    cosserat::add_structural_damping(law, effect.number("loss_factor"), frequency);
  }
  if (name == "relaxation" || name == "creep")
    cosserat::add_relaxation(law, effect.number("fraction"), effect.number("time"),
                             starts_unloaded(effect));
  if (name != "internal_friction") return;
  const double ratio = effect.number("ratio");
  if (ratio == 0.0) return;
  const bool by_moment = effect.numbers.contains("moment");
  cosserat::add_friction(
      law, ratio,
      by_moment ? effect.number("moment")
                : ratio * softer_bending(model, e) * effect.number("curvature") * length);
}

bool is_joint_law(const std::string& name) {
  static const std::array names = {"material_nonlinearity",
                                   "structural_damping",
                                   "internal_friction",
                                   "relaxation",
                                   "creep",
                                   "yield"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool is_air(const std::string& name) {
  return name == "wind" || name == "gust" || name == "leaf_drag";
}

void add_gust(const Effect& effect, RodModel& model, Diagnostics& diagnostics) {
  const double frequency = effect.number("frequency");
  if (model.gust_frequency != 0.0 && model.gust_frequency != frequency)
    diagnostics.error(effect.where,
                      "a second gust of another frequency, expected gusts of one frequency");
  model.gust_frequency = frequency;
}

}  // namespace

bool is_law(const std::string& effect) {
  return is_joint_law(effect) || is_air(effect) || effect == "stiffness_drift";
}

void apply_law(const PlantFile& plant, const Effect& effect, BuiltPlant& built,
               Diagnostics& diagnostics) {
  RodModel& model = built.model;
  const std::string& name = effect.name;
  if (name == "stiffness_drift") model.stiffness_drift += effect.number("rate");
  if (is_joint_law(name)) {
    model.laws.resize(model.elements.size());
    each_element(plant, effect, built,
                 [&](int e) { add_to_joint(model, effect, e, model.laws[e]); });
  }
  if (!is_air(name)) return;
  if (name == "gust") add_gust(effect, model, diagnostics);
  model.air.resize(model.elements.size());
  each_element(plant, effect, built, [&](int e) {
    SegmentAir& air = model.air[e];
    air.drag_area += effect.number("drag_area");
    if (name == "leaf_drag") return;
    air.velocity += vector(effect, "velocity");
    if (name == "gust") air.gust += effect.number("amplitude") * vector(effect, "velocity");
  });
}

namespace {

void check_elastic(const PlantFile& plant, const Effect& effect, const BuiltPlant& built,
                   Diagnostics& diagnostics) {
  bool empty = false;
  each_element(plant, effect, built, [&](int e) {
    const JointLaw& law = built.model.laws[e];
    empty = empty || law.elastic < 1.0e-6 || law.elastic + law.deviation < -1.0e-12;
  });
  if (empty)
    diagnostics.error(effect.where, "effect \"" + effect.name +
                                        "\" and others leave no elastic stiffness, expected the "
                                        "ratios and fractions on a curve to be less than 1 "
                                        "together");
}

void apply_yield(const PlantFile& plant, const Effect& effect, BuiltPlant& built,
                 Diagnostics& diagnostics) {
  bool hardens = false, twice = false;
  each_element(plant, effect, built, [&](int e) {
    JointLaw& law = built.model.laws[e];
    hardens = hardens || law.hardening != 0.0;
    for (const cosserat::JointBranch& branch : law.branches) twice = twice || branch.plastic;
    if (hardens || twice || law.elastic + law.deviation < 1.0e-6) return;
    cosserat::add_yield(law, softer_bending(built.model, e) * effect.number("curvature") *
                                 joint_length(built.model, e));
  });
  if (twice) diagnostics.error(effect.where, "yield twice on one curve, expected it once");
  if (hardens)
    diagnostics.error(effect.where,
                      "yield and material_nonlinearity on one curve, expected one of them");
}

}  // namespace

void finish_laws(const PlantFile& plant, BuiltPlant& built, Diagnostics& diagnostics) {
  for (const Effect& effect : plant.effects)
    if (is_joint_law(effect.name)) check_elastic(plant, effect, built, diagnostics);
  for (const Effect& effect : plant.effects)
    if (effect.name == "yield") apply_yield(plant, effect, built, diagnostics);
}

}  // namespace pedicel::plant
