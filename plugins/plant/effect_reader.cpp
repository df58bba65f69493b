#include "plugins/plant/effect_reader.h"

#include <algorithm>

namespace pedicel::plant {

namespace {

using effects::EffectDefinition;
using effects::EffectFile;
using effects::EffectParameter;

std::string names_of(EffectFile file) {
  std::string names;
  for (const EffectDefinition& one : effects::effect_definitions())
    if (one.file == file) names += (names.empty() ? "" : ", ") + one.name;
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
  } else if (parameter.size > 1) {
    std::vector<double> values = node->numbers(parameter.name, parameter.bounds);
    if (static_cast<int>(values.size()) != parameter.size) {
      node->error(parameter.name + " has " + std::to_string(values.size()) + " numbers, expected " +
                  std::to_string(parameter.size));
      values.resize(parameter.size, 0.0);
    }
    effect.numbers[parameter.name] = std::move(values);
  } else {
    effect.numbers[parameter.name] = {node->number(parameter.name, parameter.bounds)};
  }
}

}  // namespace

CurvePlace read_place(io::YamlMap& map, bool whole_curve) {
  CurvePlace place;
  if (const auto curve = map.required("curve")) {
    place.curve = curve->text("curve");
    place.where = curve->position();
  }
  place.at = whole_curve ? map.number("at", io::fraction, 0.5) : map.number("at", io::fraction);
  return place;
}

const io::KeyList& place_keys() {
  static const io::KeyList keys{
      "place",
      "a place",
      {{.name = "curve",
        .type = io::KeyType::text,
        .form = "name of a curve",
        .sentence = "the curve"},
       {.name = "at",
        .unit = "1",
        .bounds = io::fraction,
        .sentence = "fraction of the curve's arc length, as drawn, from its first point"}}};
  return keys;
}

CurvePlace read_place(io::DescribedMap& map) {
  CurvePlace place;
  if (const auto curve = map.asked("curve")) {
    place.curve = curve->text("curve");
    place.where = curve->position();
  }
  place.at = map.number("at");
  return place;
}

void read_effect_parameters(io::YamlMap& map, const std::vector<EffectParameter>& parameters,
                            Effect& effect) {
  for (const EffectParameter& parameter : parameters) read_parameter(map, parameter, effect);
}

Effect read_effect(const io::YamlNode& node, EffectFile file) {
  Effect effect;
  effect.where = node.position();
  io::YamlMap map(node, "an effect");
  const auto name = map.required("name");
  if (!name) return effect;
  effect.name = name->text("name");
  const EffectDefinition* definition = effects::find_effect(effect.name);
  if (!definition) {
    name->error("effect \"" + effect.name + "\" is unknown, expected one of: " + names_of(file));
    return effect;
  }
  if (definition->file != file) {
    name->error("effect \"" + effect.name + "\" is expected in " +
                (definition->file == EffectFile::plant ? "the plant file" : "experiment.yaml") +
                ", not here");
    return effect;
  }
  read_effect_parameters(map, definition->parameters, effect);
  if (const auto place = definition->needs_place ? map.required("where") : map.optional("where")) {
    io::YamlMap place_map(*place, "where");
    effect.place = read_place(place_map, !definition->needs_place);
    place_map.finish();
  }
  if (definition->check) definition->check(node, effect);
  map.finish();
  return effect;
}

}  // namespace pedicel::plant
