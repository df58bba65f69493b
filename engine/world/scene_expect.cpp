#include <algorithm>

#include "engine/core/joined.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world::sections {

namespace {

using io::KeyType;
using io::Told;

const io::KeyList& expectation_list() {
  const Told as_needed{"as the quantity needs"}, test{"one test"};
  const auto subject = [&](const char* name, const char* form) {
    return io::Key{.name = name,
                   .type = KeyType::text,
                   .otherwise = as_needed,
                   .form = form,
                   .sentence = "of what it is measured"};
  };
  static const io::KeyList keys{
      "expectation",
      "an expectation",
      {{.name = "quantity",
        .type = KeyType::text,
        .form = "a [quantity](quantities.md#quantities-of-a-scene)",
        .sentence = "what is measured"},
       subject("fruit", "`PLANT/FRUIT`"),
       subject("body", "name of a body"),
       subject("plant", "name of a plant"),
       subject("link", "name of a link"),
       {.name = "is",
        .unit = "of the quantity",
        .otherwise = test,
        .form = "a number, true or false",
        .sentence = "it is exactly this"},
       {.name = "between",
        .type = KeyType::numbers,
        .unit = "of the quantity",
        .otherwise = test,
        .form = "`[low, high]`",
        .sentence = "it lies there, ends included"},
       {.name = "above", .unit = "of the quantity", .otherwise = test, .sentence = "it is larger"},
       {.name = "below", .unit = "of the quantity", .otherwise = test, .sentence = "it is smaller"},
       {.name = "with_sweep",
        .type = KeyType::word,
        .otherwise = test,
        .words = {"rises", "falls", "steady"},
        .sentence = "how it goes with the values of the sweep"},
       {.name = "within",
        .unit = "1",
        .otherwise = Told{"needed for `steady`"},
        .bounds = io::positive,
        .sentence = "largest deviation, as a fraction of the mean"}}};
  return keys;
}

const MeasuredQuantity* find_quantity(const std::string& name) {
  for (const MeasuredQuantity& quantity : known_quantities())
    if (quantity.name == name) return &quantity;
  return nullptr;
}

std::string quantity_names() {
  return joined(known_quantities(), &MeasuredQuantity::name);
}

/// Whether the quantity takes a subject, and whether it must be named.
enum class Need { no, may, must };
Need need_of(const MeasuredQuantity& quantity, const std::string& subject) {
  const std::string_view text = quantity.subjects;
  if (text.find("[" + subject + "]") != std::string_view::npos) return Need::may;
  return text.find(subject) != std::string_view::npos ? Need::must : Need::no;
}

void read_subjects(io::DescribedMap& map, const MeasuredQuantity& quantity, Expectation& e) {
  const std::pair<const char*, std::string*> subjects[] = {
      {"fruit", &e.fruit}, {"body", &e.body}, {"plant", &e.plant}, {"link", &e.link}};
  for (const auto& [key, value] : subjects) {
    const auto node = map.optional(key);
    const Need need = need_of(quantity, key);
    if (node && need == Need::no)
      node->error(
          std::string(key) + ": " + e.quantity + " is not measured of a " + key +
          (quantity.subjects.empty() ? "" : ", expected " + std::string(quantity.subjects)));
    if (!node && need == Need::must)
      map.error("missing key \"" + std::string(key) + "\": " + e.quantity + " is measured of a " +
                key);
    if (node) *value = node->text(key);
  }
}

double read_is(const io::YamlNode& node) {
  if (node.is_scalar() && (node.raw().Scalar() == "true" || node.raw().Scalar() == "false"))
    return node.boolean("is") ? 1.0 : 0.0;
  return node.number("is");
}

void read_between(const io::YamlNode& node, Expectation& e) {
  const std::vector<double> bounds = node.numbers("between");
  if (bounds.size() != 2 || bounds[0] > bounds[1])
    return node.error("between: expected [low, high]");
  e.low = bounds[0];
  e.high = bounds[1];
}

/// with_sweep: rises | falls | steady; the last with `within`, the share of the mean.
void read_with_sweep(const io::YamlNode& node, io::DescribedMap& map, Expectation& e) {
  const std::string word = node.choice("with_sweep", map.key("with_sweep").words);
  if (word == "falls") e.test = Expectation::Test::falls_with_sweep;
  if (word != "steady") return;
  e.test = Expectation::Test::steady_over_sweep;
  e.low = map.required_number("within");
}

void read_test(io::DescribedMap& map, Expectation& e) {
  using Test = Expectation::Test;
  const std::pair<const char*, Test> tests[] = {{"is", Test::is},
                                                {"between", Test::between},
                                                {"above", Test::above},
                                                {"below", Test::below},
                                                {"with_sweep", Test::rises_with_sweep}};
  int found = 0;
  for (const auto& [key, test] : tests) {
    const auto node = map.optional(key);
    if (!node) continue;
    ++found;
    e.test = test;
    if (test == Test::is) {
      e.low = read_is(*node);
    } else if (test == Test::between) {
      read_between(*node, e);
    } else if (test == Test::rises_with_sweep) {
      read_with_sweep(*node, map, e);
    } else {
      e.low = node->number(key);
    }
  }
  if (map.node().is_map() && found != 1)
    map.error("an expectation: expected exactly one of is, between, above, below and with_sweep");
}

}  // namespace

std::vector<const io::KeyList*> expectation_keys() {
  return {&expectation_list()};
}

Expectation read_expectation(const io::YamlNode& node) {
  Expectation expectation;
  io::DescribedMap map(node, expectation_list());
  expectation.where = node.position();
  const auto name = map.required("quantity");
  if (name) expectation.quantity = name->text("quantity");
  const MeasuredQuantity* quantity = find_quantity(expectation.quantity);
  if (name && !quantity)
    name->error("quantity \"" + expectation.quantity +
                "\" is unknown, expected one of: " + quantity_names());
  read_subjects(map,
                quantity ? *quantity : MeasuredQuantity{"", "[fruit] [body] [plant] [link]", ""},
                expectation);
  read_test(map, expectation);
  map.finish();
  return expectation;
}

}  // namespace pedicel::world::sections
