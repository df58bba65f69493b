#include "plant/effects.h"

#include <algorithm>
#include <limits>

namespace pedicel::plant {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// E (1 + gradient (s/L - 1/2)) stays positive along the whole curve.
constexpr io::Bounds gradient{-1.99, 1.99};

std::vector<EffectKind> make_table() {
  using enum EffectHome;
  const EffectParameter factor{"factor", io::positive}, drag{"drag_area", io::not_negative},
      time{"time", io::positive}, share{"fraction", io::fraction},
      velocity{"velocity", io::any_number, 3}, stiffness{"stiffness", io::positive},
      start{"start", io::any_number, 0, false, {"settled", "unloaded"}};
  return {
      {"youngs_modulus", plant, false, true, {factor}},
      {"density", plant, false, true, {factor}},
      {"damping_time", plant, false, true, {factor}},
      {"extra_mass", plant, true, true, {{"mass", io::positive}}},
      {"mass_distribution", plant, false, true, {{"gradient", gradient}}},
      {"base_compliance", plant, false, true, {stiffness}},
      {"attachment_compliance", plant, true, true, {stiffness}},
      {"weak_segment", plant, true, true, {factor, {"length", io::positive}}},
      {"stiffness_gradient", plant, false, true, {{"gradient", gradient}}},
      {"material_nonlinearity",
       plant,
       false,
       true,
       {{"coefficient", io::any_number}, {"k0", io::positive}}},
      {"anisotropy",
       plant,
       false,
       true,
       {{"ratio", io::positive}, {"direction", io::any_number, 3}}},
      {"mass_damping", plant, false, true, {{"rate", io::not_negative}}},
      {"structural_damping",
       plant,
       false,
       true,
       {{"loss_factor", io::not_negative}, {"frequency", io::positive, 1, false}}},
      {"internal_friction",
       plant,
       false,
       true,
       {{"moment", io::positive, 1, false},
        {"curvature", io::positive, 1, false},
        {"ratio", io::fraction}}},
      {"relaxation", plant, false, true, {share, time, start}},
      {"creep", plant, false, true, {share, time, start}},
      {"yield", plant, false, true, {{"curvature", io::positive}}},
      {"stiffness_drift", plant, false, true, {{"rate", io::any_number}}},
      {"wind", plant, false, true, {velocity, drag}},
      {"gust",
       plant,
       false,
       true,
       {velocity, drag, {"frequency", io::positive}, {"amplitude", io::not_negative}}},
      {"leaf_drag", plant, false, true, {drag}},
      {"detachment_law",
       plant,
       false,
       true,
       {{"force", io::positive, 1, false},
        {"moment", io::positive, 1, false},
        {"torsion", io::positive, 1, false},
        {"exponents", io::positive, 3, false}}},
      {"grip_compliance", experiment, false, false, {stiffness}},
      {"grip_slip",
       experiment,
       false,
       false,
       {{"distance", io::any_number}, {"time", io::not_negative}}},
      {"latency", experiment, false, false, {{"delay", io::any_number}}},
      {"marker_offset",
       experiment,
       false,
       false,
       {{"marker", io::any_number, 0}, {"offset", io::any_number, 3}}},
      {"frame_rotation", experiment, false, false, {{"rotation", io::any_number, 3}}},
      {"marker_scale", experiment, false, false, {factor}},
      {"force_gain",
       experiment,
       false,
       false,
       {{"gain", io::Bounds{-infinite, infinite}}, {"offset", io::any_number, 3, false}}},
      {"outliers", experiment, false, false, {share}},
  };
}

std::string names_of(EffectHome home) {
  std::string names;
  for (const EffectKind& kind : known_effects())
    if (kind.home == home) names += (names.empty() ? "" : ", ") + kind.name;
  return names;
}

void read_word(const io::YamlNode& node, const EffectParameter& parameter, Effect& effect) {
  const std::string word = node.text(parameter.name);
  effect.words[parameter.name] = word;
  const std::vector<std::string>& known = parameter.words;
  if (known.empty() || std::find(known.begin(), known.end(), word) != known.end()) return;
  std::string list;
  for (const std::string& one : known) list += (list.empty() ? "" : " or ") + one;
  node.error(parameter.name + " is \"" + word + "\", expected " + list);
}

void read_parameter(io::YamlMap& map, const EffectParameter& parameter, Effect& effect) {
  const auto node =
      parameter.required ? map.required(parameter.name) : map.optional(parameter.name);
  if (!node) return;
  if (parameter.size == 0) {
    read_word(*node, parameter, effect);
  } else if (parameter.size == 3) {
    const Vec3 value = node->vector(parameter.name);
    effect.numbers[parameter.name] = {value.x(), value.y(), value.z()};
  } else {
    effect.numbers[parameter.name] = {node->number(parameter.name, parameter.bounds)};
  }
}

void check_detachment(const io::YamlNode& node, const Effect& effect) {
  const auto gives = [&](const char* name) { return effect.numbers.contains(name); };
  if (!gives("force") && !gives("moment") && !gives("torsion"))
    node.error(
        "detachment_law gives none of force, moment and torsion, expected at least one of them");
  if (!gives("exponents")) return;
  for (const double exponent : effect.numbers.at("exponents"))
    if (!(exponent > 0.0))
      node.error("exponents has " + std::to_string(exponent) + ", expected numbers above 0");
}

}  // namespace

const std::vector<EffectKind>& known_effects() {
  static const std::vector<EffectKind> table = make_table();
  return table;
}

const EffectKind* find_effect(const std::string& name) {
  for (const EffectKind& kind : known_effects())
    if (kind.name == name) return &kind;
  return nullptr;
}

CurvePlace read_place(io::YamlMap& map) {
  CurvePlace place;
  if (const auto curve = map.required("curve")) {
    place.curve = curve->text("curve");
    place.where = curve->position();
  }
  place.at = map.number("at", io::fraction);
  return place;
}

Effect read_effect(const io::YamlNode& node, EffectHome home) {
  Effect effect;
  effect.where = node.position();
  io::YamlMap map(node, "an effect");
  const auto name = map.required("name");
  if (!name) return effect;
  effect.name = name->text("name");
  const EffectKind* kind = find_effect(effect.name);
  if (!kind) {
    name->error("effect \"" + effect.name + "\" is unknown, expected one of: " + names_of(home));
    return effect;
  }
  if (kind->home != home) {
    name->error("effect \"" + effect.name + "\" is expected in " +
                (kind->home == EffectHome::plant ? "the plant file" : "experiment.yaml") +
                ", not here");
    return effect;
  }
  for (const EffectParameter& parameter : kind->parameters) read_parameter(map, parameter, effect);
  if (const auto place = kind->needs_place ? map.required("where") : map.optional("where")) {
    io::YamlMap place_map(*place, "where");
    effect.place = read_place(place_map);
    place_map.finish();
  }
  if (effect.name == "internal_friction" &&
      effect.numbers.contains("moment") == effect.numbers.contains("curvature"))
    node.error("internal_friction gives " +
               std::string(effect.numbers.contains("moment") ? "both" : "neither") +
               " of moment and curvature, expected one of them");
  if (effect.name == "detachment_law") check_detachment(node, effect);
  if (effect.name == "anisotropy" && effect.numbers.contains("direction")) {
    const std::vector<double>& d = effect.numbers.at("direction");
    if (Vec3(d[0], d[1], d[2]).isZero(0.0))
      node.error("anisotropy has a direction of length 0, expected a direction [x, y, z]");
  }
  map.finish();
  return effect;
}

}  // namespace pedicel::plant
