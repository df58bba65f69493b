#include "engine/io/csv.h"
#include "engine/io/thing_bounds.h"
#include "engine/io/unit_text.h"
#include "engine/io/yaml_words.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

using io::KeyType;
using io::Told;

constexpr double fastest_wind = 100.0;  // m/s

const io::KeyList& plant_list() {
  const Told source{"one of three"}, none{"none"};
  static const io::KeyList keys{
      "plant",
      "a plant",
      {{.name = "name",
        .type = KeyType::text,
        .form = "once, without `/` and `.`",
        .sentence = "its fruits are `NAME/FRUIT`"},
       {.name = "file",
        .type = KeyType::path,
        .otherwise = source,
        .sentence = "[plant file](plant_file.md), table (`*.csv`) or MTG"},
       {.name = "mtg", .type = KeyType::path, .otherwise = source, .sentence = "an MTG file"},
       {.name = "built_in",
        .type = KeyType::text,
        .otherwise = source,
        .form = "`forest`, `hanging_tree`, `cantilever`",
        .sentence = "a plant that the program makes"},
       {.name = "unit",
        .type = KeyType::text,
        .otherwise = Told{"as the file says"},
        .form = "`m`, `cm`, `mm` or metres",
        .sentence = "unit of the lengths in a skeleton of another program"},
       {.name = "repeat",
        .type = KeyType::map,
        .otherwise = Told{"once"},
        .sentence = "a grid of plants, named `NAME_0`, `NAME_1` and so on, along X first"},
       {.name = "set",
        .type = KeyType::map,
        .otherwise = none,
        .sentence = "[settings of a plant](settings.md#plants), over what its file says"},
       {.name = "optional",
        .type = KeyType::flag,
        .otherwise = false,
        .sentence = "a file that is absent skips the scene"},
       {.name = "fallback",
        .type = KeyType::path,
        .otherwise = none,
        .sentence = "plant file in place of an absent optional one"}},
      "",
      {&pose_keys()}};
  return keys;
}

const io::KeyList& repeat_list() {
  static const io::KeyList keys{"repeat",
                                "repeat",
                                {{.name = "count",
                                  .type = KeyType::numbers,
                                  .unit = "1",
                                  .bounds = {1, 10000},
                                  .form = "two whole ones",
                                  .sentence = "plants along X and Y"},
                                 {.name = "spacing",
                                  .type = KeyType::numbers,
                                  .unit = "m",
                                  .bounds = io::extent_bounds,
                                  .form = "two",
                                  .sentence = "distances along X and Y"},
                                 {.name = "vary",
                                  .type = KeyType::map,
                                  .otherwise = Told{"none"},
                                  .form = "keys with distributions",
                                  .sentence = "in what the plants differ, below"}},
                                "repeat"};
  return keys;
}

const io::KeyList& load_list() {
  static const io::KeyList keys{
      "load",
      "a load",
      {{.name = "fruit",
        .type = KeyType::text,
        .form = "`PLANT/FRUIT`",
        .sentence = "what is pulled"},
       {.name = "force", .type = KeyType::vector, .unit = "N", .sentence = "in the world"},
       {.name = "from",
        .unit = "s",
        .otherwise = SceneLoad{}.from,
        .bounds = io::not_negative,
        .sentence = "the load begins"},
       {.name = "to",
        .unit = "s",
        .bounds = io::positive,
        .form = "after `from`",
        .sentence = "the load ends"},
       {.name = "ramp",
        .type = KeyType::flag,
        .otherwise = SceneLoad{}.ramp,
        .sentence = "it grows from 0 at `from` to the whole force at `to`"}}};
  return keys;
}

const io::KeyList& tie_list() {
  const Told end{"one of three"};
  static const io::KeyList keys{
      "tie",
      "a tie",
      {{.name = "organ",
        .type = KeyType::text,
        .form = "`PLANT/CURVE` or `PLANT/FRUIT`",
        .sentence = "what is tied; the name of a grid ties each of its plants"},
       {.name = "at",
        .unit = "1",
        .otherwise = SceneTie{}.at,
        .bounds = io::fraction,
        .sentence = "where on the curve, from its foot"},
       {.name = "to",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = end,
        .bounds = io::place_bounds,
        .sentence = "the fixed point, in the world"},
       {.name = "offset",
        .type = KeyType::vector,
        .unit = "m",
        .otherwise = end,
        .bounds = io::place_bounds,
        .sentence = "the fixed point, from the tied place as drawn"},
       {.name = "to_organ",
        .type = KeyType::text,
        .otherwise = end,
        .form = "`PLANT/CURVE` or `PLANT/FRUIT`",
        .sentence = "where it ends on a plant; the name of a grid: the plant of the same number"},
       {.name = "to_at",
        .unit = "1",
        .otherwise = Told{"nearest to the tied place"},
        .bounds = io::fraction,
        .sentence = "where on that curve, from its foot"},
       {.name = "length",
        .unit = "m",
        .otherwise = Told{"as drawn"},
        .bounds = io::not_negative,
        .sentence = "it pulls beyond this length"},
       {.name = "stiffness",
        .unit = "N/m",
        .otherwise = SceneTie{}.stiffness,
        .bounds = {1.0e-3, 1.0e9},
        .sentence = "how hard it pulls for each metre"}}};
  return keys;
}

const io::KeyList& cut_list() {
  static const io::KeyList keys{
      "cut",
      "a cut",
      {{.name = "organ", .type = KeyType::text, .form = "`PLANT/CURVE`", .sentence = "what is cut"},
       {.name = "at",
        .unit = "1",
        .otherwise = SceneCut{}.at,
        .bounds = io::fraction,
        .sentence = "where on the curve, from its foot"},
       {.name = "time",
        .unit = "s",
        .otherwise = Told{"one of two"},
        .bounds = io::not_negative,
        .sentence = "when"},
       {.name = "by_tool",
        .type = KeyType::flag,
        .otherwise = false,
        .form = "one of two",
        .sentence = "as soon as the tool is near"},
       {.name = "reach",
        .unit = "m",
        .otherwise = SceneCut{}.reach,
        .bounds = io::positive,
        .sentence = "so near: from the tool's point to the place"}}};
  return keys;
}

const io::KeyList& wind_list() {
  static const io::KeyList keys{
      "wind",
      "wind",
      {{.name = "velocity",
        .type = KeyType::vector,
        .unit = "m/s",
        .form = "at most " + io::format_number(fastest_wind) + ", not straight up",
        .sentence = "mean of the wind, at `height`"},
       {.name = "height",
        .unit = "m",
        .otherwise = SceneWind{}.height,
        .bounds = io::positive,
        .sentence = "where it has that mean"},
       {.name = "roughness",
        .unit = "m",
        .otherwise = SceneWind{}.roughness,
        .bounds = io::not_negative,
        .form = "at most half of `height`",
        .sentence = "of the ground: the mean grows with ln(z / roughness); 0: it does not"},
       {.name = "intensity",
        .unit = "1",
        .otherwise = SceneWind{}.intensity,
        .bounds = io::fraction,
        .sentence = "rms of the gusts over the mean"},
       {.name = "length",
        .unit = "m",
        .otherwise = SceneWind{}.length,
        .bounds = io::positive,
        .sentence = "of the gusts"},
       {.name = "rise",
        .unit = "s",
        .otherwise = SceneWind{}.rise,
        .bounds = io::not_negative,
        .sentence = "over which the wind sets in"},
       {.name = "shelter",
        .type = KeyType::flag,
        .otherwise = SceneWind{}.shelter,
        .sentence = "plants take wind from those behind them"}}};
  return keys;
}

void read_source(io::DescribedMap& map, const std::filesystem::path& folder, ScenePlant& plant) {
  plant.optional = map.boolean("optional");
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

void read_repeat(io::DescribedMap& map, ScenePlant& plant) {
  const auto node = map.optional("repeat");
  if (!node) return;
  io::DescribedMap repeat(*node, repeat_list());
  const auto count = repeat.list("count"), spacing = repeat.list("spacing");
  if (count.size() != 2) repeat.error("repeat.count: expected [along X, along Y]");
  if (spacing.size() != 2) repeat.error("repeat.spacing: expected [along X, along Y] in m");
  const io::Bounds &plants = repeat.key("count").bounds, &apart = repeat.key("spacing").bounds;
  for (int i = 0; i < 2; ++i) {
    if (count.size() == 2)
      plant.repeat[i] = count[i].integer("repeat.count", static_cast<int>(plants.minimum),
                                         static_cast<int>(plants.maximum));
    if (spacing.size() == 2) plant.spacing[i] = spacing[i].number("repeat.spacing", apart);
  }
  if (const auto vary = repeat.optional("vary")) plant.vary = read_vary(*vary);
  repeat.finish();
}

}  // namespace

std::vector<const io::KeyList*> plant_keys() {
  return {&plant_list(), &repeat_list(), &load_list(), &tie_list(), &cut_list(), &wind_list()};
}

ScenePlant read_plant(const io::YamlNode& node, const std::filesystem::path& folder) {
  ScenePlant plant;
  io::DescribedMap map(node, plant_list());
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
  io::DescribedMap map(node, load_list());
  load.where = node.position();
  load.target = map.text("fruit");
  load.force = map.vector("force");
  load.from = map.number("from");
  load.to = map.number("to");
  load.ramp = map.boolean("ramp");
  if (map.has("to") && load.to <= load.from) node.error("a load: expected from < to");
  map.finish();
  return load;
}

SceneTie read_tie(const io::YamlNode& node) {
  SceneTie tie;
  io::DescribedMap map(node, tie_list());
  tie.where = node.position();
  tie.organ = map.text("organ");
  tie.at = map.number("at");
  const auto to = map.optional("to"), offset = map.optional("offset"),
             to_organ = map.optional("to_organ"), to_at = map.optional("to_at");
  if (node.is_map() && to.has_value() + offset.has_value() + to_organ.has_value() != 1)
    map.error(
        "a tie: expected exactly one of to (m, in the world), offset (m, from the tied place as "
        "drawn) and to_organ (PLANT/CURVE or PLANT/FRUIT)");
  if (to_organ) tie.to_organ = to_organ->text("to_organ");
  if (to_at && !to_organ) to_at->error("to_at: expected only beside to_organ");
  tie.to_at = map.optional_number("to_at");
  tie.is_offset = offset.has_value();
  if (to || offset) tie.to = read_place(map, tie.is_offset ? "offset" : "to");
  tie.length = map.optional_number("length");
  tie.stiffness = map.number("stiffness");
  map.finish();
  return tie;
}

SceneCut read_cut(const io::YamlNode& node) {
  SceneCut cut;
  io::DescribedMap map(node, cut_list());
  cut.where = node.position();
  cut.organ = map.text("organ");
  cut.at = map.number("at");
  const bool by_tool = map.boolean("by_tool");
  const bool is_clear = map.has("time") != by_tool;
  if (node.is_map() && !is_clear)
    map.error("a cut: expected exactly one of time (s) and by_tool: true");
  if (!is_clear) cut.time = 0.0;  // what is asked of a tool is not asked then
  if (const auto time = map.optional_number("time")) cut.time = time;
  cut.reach = map.number("reach");
  map.finish();
  return cut;
}

SceneWind read_wind(const io::YamlNode& node) {
  SceneWind wind;
  io::DescribedMap map(node, wind_list());
  const int before = node.diagnostics().error_count();
  wind.velocity = map.vector("velocity");
  const bool is_read = node.diagnostics().error_count() == before && node.is_map();
  if (!is_read) wind.velocity = Vec3::UnitX();
  if (wind.velocity.head<2>().isZero(0.0) || wind.velocity.norm() > fastest_wind)
    node.error("wind: velocity " + in_quotes(io::yaml_number(wind.velocity.norm())) +
               " m/s, expected one along the ground of at most " + io::yaml_number(fastest_wind));
  wind.height = map.number("height");
  wind.roughness = map.number("roughness");
  // Nearer to each other, the logarithm of their ratio would multiply the wind.
  if (wind.roughness > 0.5 * wind.height)
    map.error("wind: expected a roughness of at most half of the height");
  wind.intensity = map.number("intensity");
  wind.length = map.number("length");
  wind.rise = map.number("rise");
  wind.shelter = map.boolean("shelter");
  map.finish();
  return wind;
}

}  // namespace pedicel::world::sections
