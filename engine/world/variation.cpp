#include "engine/world/variation.h"

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "engine/io/csv.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world {

namespace {

using io::KeyType;
using io::Told;

/// Of the logarithm of a mean there must be a finite one.
constexpr double least_lognormal = 1.0e-300, largest_varied = 1.0e300;

using Distribution = VariedNumber::Distribution;

constexpr std::size_t most_varied = 1000;  // each is looked for in all of the others

const std::vector<std::string>& distribution_words() {
  static const std::vector<std::string> words = {"uniform", "normal", "lognormal", "choice"};
  return words;
}

const io::KeyList& varied_list() {
  const Told limit{"needed for `uniform`"}, mean{"needed for normal and lognormal"};
  static const io::KeyList keys{"varied",
                                "what varies",
                                {{.name = "distribution",
                                  .type = KeyType::word,
                                  .otherwise = distribution_words().front(),
                                  .words = distribution_words(),
                                  .sentence = "how the value is drawn"},
                                 {.name = "low",
                                  .unit = "of the key",
                                  .otherwise = limit,
                                  .sentence = "not below this; else it is drawn again"},
                                 {.name = "high",
                                  .unit = "of the key",
                                  .otherwise = limit,
                                  .form = "`low` or more",
                                  .sentence = "not above this; else it is drawn again"},
                                 {.name = "mean",
                                  .unit = "of the key",
                                  .otherwise = mean,
                                  .bounds = {-largest_varied, largest_varied},
                                  .form = "above 0 for lognormal",
                                  .sentence = "of the value itself, also of a lognormal one"},
                                 {.name = "deviation",
                                  .unit = "of the key",
                                  .otherwise = mean,
                                  .bounds = {0.0, largest_varied},
                                  .sentence = "of the value itself, also of a lognormal one"},
                                 {.name = "values",
                                  .type = KeyType::list,
                                  .otherwise = Told{"needed for `choice`"},
                                  .form = "one or more",
                                  .sentence = "one of these"}}};
  return keys;
}

const io::KeyList& variation_list() {
  static const io::KeyList keys{"variation",
                                "a variation",
                                {io::format_key("pedicel-variation"),
                                 io::version_key(),
                                 {.name = "vary",
                                  .type = KeyType::map,
                                  .form = "keys of `--set` with distributions",
                                  .sentence = "what varies"}}};
  return keys;
}

void read_bounds(io::DescribedMap& map, VariedNumber& one, bool required) {
  const int before = map.node().diagnostics().error_count();
  one.low = -std::numeric_limits<double>::infinity();
  one.high = -one.low;
  if (required || map.has("low")) one.low = map.required_number("low");
  if (required || map.has("high")) one.high = map.required_number("high");
  const bool is_read = map.node().diagnostics().error_count() == before;
  if (is_read && map.has("low") && map.has("high") && one.low > one.high)
    map.error("low is above high, expected low <= high");
}

void read_values(io::DescribedMap& map, VariedNumber& one) {
  const auto node = map.required("values");
  if (node)
    for (const io::YamlNode& value : node->list("values"))
      one.values.push_back(value.text("values"));
  if (!one.values.empty()) return;
  if (node && node->is_list()) node->error("values: is empty, expected one or more");
  one.values.emplace_back();  // nothing may be drawn from none
}

VariedNumber read_number(const std::string& key, const io::YamlNode& node) {
  VariedNumber one;
  one.key = key;
  one.where = node.position();
  io::DescribedMap map(node, varied_list());
  const std::string word = map.choice("distribution");
  const auto found = std::ranges::find(distribution_words(), word) - distribution_words().begin();
  one.distribution = static_cast<Distribution>(found);
  if (one.distribution == Distribution::choice) {
    read_values(map, one);
  } else if (one.distribution == Distribution::uniform) {
    read_bounds(map, one, true);
  } else {
    io::Bounds means = map.key("mean").bounds;
    if (one.distribution == Distribution::lognormal) means.minimum = least_lognormal;
    if (const auto mean = map.required("mean")) one.mean = mean->number("mean", means);
    one.deviation = map.required_number("deviation");
    read_bounds(map, one, false);
  }
  map.finish();
  return one;
}

double draw_once(const VariedNumber& one, Random& random) {
  if (one.distribution == Distribution::uniform) return random.uniform(one.low, one.high);
  const double unit = random.normal();
  if (one.distribution == Distribution::normal) return one.mean + one.deviation * unit;
  // Mean and deviation of exp(m + s unit) are those asked for.
  const double s2 = std::log1p(std::pow(one.deviation / one.mean, 2));
  return std::exp(std::log(one.mean) - 0.5 * s2 + std::sqrt(s2) * unit);
}

std::string draw_text(const VariedNumber& one, Random& random) {
  if (one.distribution == Distribution::choice)
    return one.values[static_cast<std::size_t>(
        random.integer(0, static_cast<int>(one.values.size()) - 1))];
  constexpr int tries = 1000;
  double value = draw_once(one, random);
  for (int i = 0; i < tries && !(value >= one.low && value <= one.high); ++i)
    value = draw_once(one, random);
  return io::exact_number(std::clamp(value, one.low, one.high));
}

}  // namespace

std::vector<const io::KeyList*> variation_keys() {
  return {&varied_list(), &variation_list()};
}

std::vector<VariedNumber> read_vary(const io::YamlNode& node) {
  std::vector<VariedNumber> all;
  if (!node.is_map()) {
    node.error("vary: expected a map of keys of --set");
    return all;
  }
  if (node.raw().size() > most_varied) {
    node.error("vary: has " + std::to_string(node.raw().size()) + " keys, expected at most " +
               std::to_string(most_varied));
    return all;
  }
  for (const auto& entry : node.raw())
    all.push_back(
        read_number(entry.first.Scalar(), {entry.second, node.file(), node.diagnostics()}));
  return all;
}

Variation Variation::read(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  Variation variation;
  io::DescribedMap map(io::load_yaml(path, diagnostics), variation_list());
  if (map.has_format()) {
    if (const auto vary = map.required("vary")) variation.numbers_ = read_vary(*vary);
    map.finish();
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return variation;
}

Variation Variation::parse(const std::string& text, const std::string& name) {
  Diagnostics diagnostics;
  Variation variation;
  variation.numbers_ = read_vary(io::parse_yaml(text, name, diagnostics));
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return variation;
}

std::vector<std::pair<std::string, std::string>> draw(const std::vector<VariedNumber>& numbers,
                                                      std::uint64_t seed) {
  std::vector<std::pair<std::string, std::string>> drawn;
  Random random(seed);
  for (const VariedNumber& one : numbers) {
    std::string text = draw_text(one, random);
    if (!one.held) drawn.emplace_back(one.key, std::move(text));
  }
  return drawn;
}

}  // namespace pedicel::world
