#include "pedicel/io/unit_text.h"
#include "pedicel/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

void read_source(io::YamlMap& map, const std::filesystem::path& folder, ScenePlant& plant) {
  plant.optional = map.boolean("optional", false);
  const auto file = map.optional("file"), mtg = map.optional("mtg"),
             built_in = map.optional("built_in");
  if (file.has_value() + mtg.has_value() + built_in.has_value() != 1)
    map.error("a plant: expected exactly one of file, mtg and built_in");
  if (file) plant.file = read_path(*file, "file", folder, plant.optional);
  if (mtg) {
    plant.source = ScenePlant::Source::mtg;
    plant.file = read_path(*mtg, "mtg", folder, plant.optional);
  }
  if (const auto unit = map.optional("unit")) {
    const std::string text = unit->text("unit");
    const std::optional<double> metres = io::length_unit(text);
    if (!metres && !text.empty())
      unit->error("unit is " + in_quotes(text) + ", expected " + io::expected_length_units());
    if (built_in) unit->error("unit: a built-in plant has its own lengths, expected none");
    plant.unit = metres.value_or(0.0);
  }
  if (built_in) {
    plant.source = ScenePlant::Source::built_in;
    plant.built_in = built_in->text("built_in");
  }
  if (const auto fallback = map.optional("fallback")) {
    if (!plant.optional) fallback->error("fallback: expected only beside \"optional: true\"");
    plant.fallback = read_path(*fallback, "fallback", folder);
  }
}

void read_repeat(io::YamlMap& map, ScenePlant& plant) {
  const auto node = map.optional("repeat");
  if (!node) return;
  io::YamlMap repeat(*node, "repeat");
  const auto count = repeat.list("count"), spacing = repeat.list("spacing");
  if (count.size() != 2) repeat.error("repeat.count: expected [along X, along Y]");
  if (spacing.size() != 2) repeat.error("repeat.spacing: expected [along X, along Y] in m");
  for (int i = 0; i < 2; ++i) {
    if (count.size() == 2) plant.repeat[i] = count[i].integer("repeat.count", 1, 10000);
    if (spacing.size() == 2) plant.spacing[i] = spacing[i].number("repeat.spacing", io::positive);
  }
  repeat.finish();
}

}  // namespace

ScenePlant read_plant(const io::YamlNode& node, const std::filesystem::path& folder) {
  ScenePlant plant;
  io::YamlMap map(node, "a plant");
  plant.where = node.position();
  plant.name = map.text("name");
  if (plant.name.find_first_of("/.") != std::string::npos)
    node.error("name \"" + plant.name + "\": expected a name without \"/\" and \".\"");
  read_source(map, folder, plant);
  plant.pose = read_pose(map);
  read_repeat(map, plant);
  if (const auto set = map.optional("set")) plant.set = read_settings(*set, "set");
  map.finish();
  return plant;
}

SceneLoad read_load(const io::YamlNode& node) {
  SceneLoad load;
  io::YamlMap map(node, "a load");
  load.where = node.position();
  load.target = map.text("fruit");
  load.force = map.vector("force");
  load.from = map.number("from", io::not_negative, 0.0);
  load.to = map.number("to", io::positive);
  load.ramp = map.boolean("ramp", false);
  if (load.to <= load.from) node.error("a load: expected from < to");
  map.finish();
  return load;
}

}  // namespace pedicel::world::sections
