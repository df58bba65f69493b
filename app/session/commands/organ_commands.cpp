#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "app/session/document/effective_plant.h"
#include "engine/io/csv.h"
#include "plugins/plant/organ_edit.h"
#include "plugins/plant/plant_edit.h"

/// Fruits, leaves, masses, supports and materials as commands: thin covers of plant/organ_edit.h.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

const ArgumentDescription plant_name{"plant", Kind::word, true, "name of the plant in the scene"};
const ArgumentDescription organ_name{"name", Kind::word, true, "of the fruit or leaf"};
const ArgumentDescription stem_name{"stem", Kind::word, true, "that carries it"};
const ArgumentDescription place{"at", Kind::number, true, "fraction of the stem's length"};

plant::PlantFile& edited(Document& document, const Command& c) {
  return document.edit_plant(c.word("plant"));
}

/// The numbers that a command gives a new organ, as the plant's keys describe them.
template <typename Owner, typename Keys>
void take_numbers(const Command& c, const Keys& keys, Owner& owner) {
  for (const plant::PlantKey<Owner>& key : keys) {
    if (!key.is_number()) continue;
    const std::string name(key.name);
    const std::optional<double> value = c.has(name) ? std::optional(c.number(name)) : key.usual;
    if (value) plant::set_number_of(owner, key, value);
  }
}

/// Their descriptions: "N, at which it comes off".
template <typename Owner, std::size_t Count>
void add_number_arguments(std::vector<ArgumentDescription>& arguments,
                          const plant::PlantKey<Owner> (&keys)[Count]) {
  for (const plant::PlantKey<Owner>& key : keys) {
    if (!key.is_number()) continue;
    std::string sentence(key.unit == "1" ? "" : key.unit);
    if (!key.tip.empty()) sentence += (sentence.empty() ? "" : ", ") + std::string(key.tip);
    if (key.usual) sentence += " (" + io::format_number(*key.usual) + ")";
    const bool needed =
        std::holds_alternative<double Owner::*>(key.member) && !key.otherwise && !key.usual;
    arguments.push_back({std::string(key.name), Kind::number, needed, sentence});
  }
}

/// "youngs_modulus (Pa), poisson_ratio".
template <typename Keys>
std::string names_with_units(const Keys& keys) {
  std::string text;
  for (const auto& key : keys)
    if (key.is_number())
      text += (text.empty() ? "" : ", ") + std::string(key.name) +
              (key.unit == "1" ? "" : " (" + std::string(key.unit) + ")");
  return text;
}

void add_fruit(Document& document, const Command& c) {
  plant::PlantFruit fruit;
  fruit.name = c.word("name");
  fruit.place = {c.word("stem"), c.number("at"), {}};
  take_numbers(c, plant::fruit_keys, fruit);
  take_numbers(c, plant::detach_keys, fruit.detach);
  plant::add_fruit(edited(document, c), std::move(fruit));
}

void add_leaf(Document& document, const Command& c) {
  plant::PlantLeaf leaf;
  leaf.name = c.word("name");
  leaf.place = {c.word("stem"), c.number("at"), {}};
  leaf.leaf_template = c.word_or("template", "tomato");
  take_numbers(c, plant::leaf_keys, leaf);
  if (c.has("normal")) leaf.normal = c.point("normal");
  if (c.has("direction")) leaf.direction = c.point("direction");
  plant::add_leaf(edited(document, c), std::move(leaf));
}

const ArgumentDescription index_in_file{"index", Kind::whole, true, "number in the file, from 0"};

std::vector<CommandDescription> plant_value_commands() {
  return {
      {"set material",
       {plant_name,
        {"key", Kind::word, true, names_with_units(plant::material_keys)},
        {"value", Kind::number, true, "of the key; 0 takes a stem's own away"},
        {"stem", Kind::word, false, "one stem; left out: the plant's default"}},
       "Sets a constant of the plant's material, or of one stem's.",
       [](Document& document, const Command& c) {
         plant::set_material(edited(document, c), c.word_or("stem", ""), c.word("key"),
                             c.number("value"));
       }},
      {"keep setting",
       {{"key", Kind::word, true, "of a plant, that was set: plants.NAME.KEY, or KEY of all"}},
       "Writes one setting into the plants that it is about, so that it is no setting any more.",
       [](Document& document, const Command& c) { keep_setting(document, c.word("key")); }},
      {"set sampling",
       {plant_name,
        {"key", Kind::word, true, plant::number_names(plant::sampling_keys, " or ")},
        {"value", Kind::number, true, "m"}},
       "Sets how near ends are joined, or how far nodes lie apart.",
       [](Document& document, const Command& c) {
         plant::set_sampling(edited(document, c), c.word("key"), c.number("value"));
       }},
      {"set shape",
       {plant_name,
        {"shape",
         Kind::word,
         true,
         "drawn or rest",
         {},
         {std::begin(plant::shape_words), std::end(plant::shape_words)}}},
       "Whether the drawing is how the plant hangs, or its unloaded shape.",
       [](Document& document, const Command& c) {
         edited(document, c).shape = static_cast<plant::Shape>(c.choice("shape"));
       }},
      {"set plant look",
       {plant_name,
        {"look",
         Kind::word,
         true,
         "tomato or apple",
         {},
         {std::begin(plant::look_words), std::end(plant::look_words)}}},
       "What the plant is drawn as; it changes no motion.",
       [](Document& document, const Command& c) {
         edited(document, c).look = static_cast<plant::Look>(c.choice("look"));
       }},
      {"set root",
       {plant_name, {"to", Kind::point, true, "m, in the plant's frame"}},
       "Where the plant is clamped.",
       [](Document& document, const Command& c) { edited(document, c).root = c.point("to"); }},
  };
}

}  // namespace

std::vector<CommandDescription> organ_commands() {
  std::vector<ArgumentDescription> of_fruit{plant_name, organ_name, stem_name, place};
  add_number_arguments(of_fruit, plant::fruit_keys);
  add_number_arguments(of_fruit, plant::detach_keys);
  std::vector<ArgumentDescription> of_leaf{plant_name, organ_name, stem_name, place};
  add_number_arguments(of_leaf, plant::leaf_keys);
  of_leaf.push_back({"template", Kind::word, false, "name of the leaf's shape (tomato)"});
  of_leaf.push_back({"normal", Kind::point, false, "the way its upper face looks (up)"});
  of_leaf.push_back({"direction", Kind::point, false, "the way its midrib points"});
  std::vector<CommandDescription> table = {
      {"add fruit", of_fruit, "Hangs a fruit on a stem.", add_fruit},
      {"add leaf", of_leaf, "Puts a leaf on a stem.", add_leaf},
      {"move organ",
       {plant_name, organ_name, stem_name, place},
       "Moves a fruit or leaf along its stem, or to another.",
       [](Document& document, const Command& c) {
         plant::place_organ(edited(document, c), c.word("name"), c.word("stem"), c.number("at"));
       }},
      {"delete organ",
       {plant_name, organ_name},
       "Takes a fruit or leaf away.",
       [](Document& document, const Command& c) {
         plant::remove_organ(edited(document, c), c.word("name"));
       }},
      {"set organ",
       {plant_name,
        organ_name,
        {"key", Kind::word, true,
         plant::number_names(plant::fruit_keys) + ", " + plant::number_names(plant::detach_keys) +
             " of a fruit; " + plant::number_names(plant::leaf_keys) + " of a leaf"},
        {"value", Kind::number, true, "of the key; a threshold of 0 is none"}},
       "Sets a number of a fruit or leaf.",
       [](Document& document, const Command& c) {
         plant::set_organ(edited(document, c), c.word("name"), c.word("key"), c.number("value"));
       }},
      {"turn leaf",
       {plant_name,
        organ_name,
        {"normal", Kind::point, true, "the way its upper face looks"},
        {"direction", Kind::point, false, "the way its midrib points; left out: by itself"}},
       "Turns a leaf.",
       [](Document& document, const Command& c) {
         plant::turn_leaf(edited(document, c), c.word("name"), c.point("normal"),
                          c.has("direction") ? c.point("direction") : Vec3(Vec3::Zero()));
       }},
      {"add mass",
       {plant_name, stem_name, place, {"mass", Kind::number, true, "kg"}},
       "Fixes a point mass to a stem.",
       [](Document& document, const Command& c) {
         plant::add_mass(edited(document, c), c.word("stem"), c.number("at"), c.number("mass"));
       }},
      {"delete mass",
       {plant_name, index_in_file},
       "Takes a point mass away.",
       [](Document& document, const Command& c) {
         plant::remove_mass(edited(document, c), c.whole("index"));
       }},
      {"add support",
       {plant_name, stem_name, place},
       "Clamps a place of a stem.",
       [](Document& document, const Command& c) {
         plant::add_support(edited(document, c), c.word("stem"), c.number("at"));
       }},
      {"delete support",
       {plant_name, index_in_file},
       "Takes a clamp away.",
       [](Document& document, const Command& c) {
         plant::remove_support(edited(document, c), c.whole("index"));
       }},
  };
  for (const CommandDescription& one : plant_value_commands()) table.push_back(one);
  return table;
}

}  // namespace pedicel::app
