#include "pedicel/io/thing_bounds.h"
#include "pedicel/io/unit_text.h"
#include "pedicel/io/yaml_words.h"
#include "pedicel/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

constexpr double fastest_wind = 100.0;  // m/s

void read_source(io::YamlMap& map, const std::filesystem::path& folder, ScenePlant& plant) {
  plant.optional = map.boolean("optional", false);
  const auto file = map.optional("file"), mtg = map.optional("mtg"),
             built_in = map.optional("built_in");
  if (map.node().is_map() && file.has_value() + mtg.has_value() + built_in.has_value() != 1)
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
    if (spacing.size() == 2)
      plant.spacing[i] = spacing[i].number("repeat.spacing", io::extent_bounds);
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
  if (map.has("to") && load.to <= load.from) node.error("a load: expected from < to");
  map.finish();
  return load;
}

SceneTie read_tie(const io::YamlNode& node) {
  SceneTie tie;
  io::YamlMap map(node, "a tie");
  tie.where = node.position();
  tie.organ = map.text("organ");
  tie.at = map.number("at", io::fraction, 1.0);
  const auto to = map.optional("to"), offset = map.optional("offset"),
             to_organ = map.optional("to_organ"), to_at = map.optional("to_at");
  if (node.is_map() && to.has_value() + offset.has_value() + to_organ.has_value() != 1)
    map.error(
        "a tie: expected exactly one of to (m, in the world), offset (m, from the tied place as "
        "drawn) and to_organ (PLANT/CURVE or PLANT/FRUIT)");
  if (to_organ) tie.to_organ = to_organ->text("to_organ");
  if (to_at && !to_organ) to_at->error("to_at: expected only beside to_organ");
  if (to_at) tie.to_at = to_at->number("to_at", io::fraction);
  tie.is_offset = offset.has_value();
  if (to || offset) tie.to = read_place(map, tie.is_offset ? "offset" : "to");
  if (map.optional("length")) tie.length = map.number("length", io::not_negative);
  tie.stiffness = map.number("stiffness", {1.0e-3, 1.0e9}, tie.stiffness);
  map.finish();
  return tie;
}

SceneCut read_cut(const io::YamlNode& node) {
  SceneCut cut;
  io::YamlMap map(node, "a cut");
  cut.where = node.position();
  cut.organ = map.text("organ");
  cut.at = map.number("at", io::fraction, cut.at);
  const bool by_tool = map.boolean("by_tool", false);
  const bool is_clear = map.has("time") != by_tool;
  if (node.is_map() && !is_clear)
    map.error("a cut: expected exactly one of time (s) and by_tool: true");
  if (!is_clear) cut.time = 0.0;  // what is asked of a tool is not asked then
  if (map.has("time")) cut.time = map.number("time", io::not_negative);
  cut.reach = map.number("reach", io::positive, cut.reach);
  map.finish();
  return cut;
}

SceneWind read_wind(const io::YamlNode& node) {
  SceneWind wind;
  io::YamlMap map(node, "wind");
  const int before = node.diagnostics().error_count();
  wind.velocity = map.vector("velocity");
  const bool is_read = node.diagnostics().error_count() == before && node.is_map();
  if (!is_read) wind.velocity = Vec3::UnitX();
  if (wind.velocity.head<2>().isZero(0.0) || wind.velocity.norm() > fastest_wind)
    node.error("wind: velocity " + in_quotes(io::yaml_number(wind.velocity.norm())) +
               " m/s, expected one along the ground of at most " + io::yaml_number(fastest_wind));
  wind.height = map.number("height", io::positive, wind.height);
  wind.roughness = map.number("roughness", io::not_negative, wind.roughness);
  // Nearer to each other, the logarithm of their ratio would multiply the wind.
  if (wind.roughness > 0.5 * wind.height)
    map.error("wind: expected a roughness of at most half of the height");
  wind.intensity = map.number("intensity", io::fraction, wind.intensity);
  wind.length = map.number("length", io::positive, wind.length);
  wind.rise = map.number("rise", io::not_negative, wind.rise);
  wind.shelter = map.boolean("shelter", wind.shelter);
  map.finish();
  return wind;
}

}  // namespace pedicel::world::sections
