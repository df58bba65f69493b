#include <type_traits>

#include "engine/core/joined.h"
#include "engine/io/atomic_file.h"
#include "engine/io/yaml_words.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::plant {

namespace {

std::string exact(double value) {
  return io::yaml_number(value);
}

std::string word(const std::string& text) {
  return yaml_word(text);
}

std::string list(const std::vector<double>& values) {
  const std::string text = joined(values, exact);
  return "[" + text + "]";
}

std::string vector(const Vec3& v) {
  return list({v.x(), v.y(), v.z()});
}

std::string scalar_or_list(const std::vector<double>& values) {
  return values.size() == 1 ? exact(values.front()) : list(values);
}

/// A map in one line, {key: value, ...}.
class FlowMap {
 public:
  FlowMap& add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "" : ", ") + key + ": " + value;
    return *this;
  }
  FlowMap& add(const std::string& key, double value) { return add(key, exact(value)); }
  FlowMap& add(const std::string& key, const std::optional<double>& value) {
    return value ? add(key, *value) : *this;
  }
  FlowMap& add(const CurvePlace& place) {
    return add("curve", word(place.curve)).add("at", place.at);
  }
  bool empty() const { return text_.empty(); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

/// What a file says of a key; nothing where it does not have to say it.
template <typename Owner>
std::optional<std::string> written(const PlantKey<Owner>& key, const Owner& owner) {
  if (key.stands && !key.stands(owner)) return std::nullopt;
  const auto write = [&](auto member) -> std::optional<std::string> {
    using Member = decltype(member);
    if constexpr (std::is_same_v<Member, double Owner::*>) {
      if (key.otherwise && owner.*member == *key.otherwise) return std::nullopt;
      return exact(owner.*member);
    } else if constexpr (std::is_same_v<Member, std::optional<double> Owner::*>) {
      if (!(owner.*member)) return std::nullopt;
      return exact(*(owner.*member));
    } else if constexpr (std::is_same_v<Member, Vec3 Owner::*>) {
      return vector(owner.*member);
    } else if constexpr (std::is_same_v<Member, std::optional<Vec3> Owner::*>) {
      if (!(owner.*member)) return std::nullopt;
      return vector(*(owner.*member));
    } else if constexpr (std::is_same_v<Member, std::string Owner::*>) {
      return word(owner.*member);
    } else {
      const int index = member.get(owner);
      if (index == 0 && !member.always_written) return std::nullopt;
      return std::string(member.words[static_cast<std::size_t>(index)]);
    }
  };
  return std::visit(write, key.member);
}

/// Calls add(key, text) for each of the keys that a file says.
template <typename Owner, typename Keys, typename Add>
void write_keys(const Keys& keys, const Owner& owner, Add&& add) {
  for (const PlantKey<Owner>& key : keys)
    if (const auto text = written(key, owner)) add(std::string(key.name), *text);
}

template <typename Owner, typename Keys>
FlowMap& add_keys(FlowMap& map, const Keys& keys, const Owner& owner) {
  write_keys(keys, owner,
             [&](const std::string& key, const std::string& text) { map.add(key, text); });
  return map;
}

/// The same, each in a line of its own.
template <typename Owner, typename Keys>
std::string lines_of(const std::string& indent, const Keys& keys, const Owner& owner) {
  std::string lines;
  write_keys(keys, owner, [&](const std::string& key, const std::string& text) {
    lines += indent + key + ": " + text + "\n";
  });
  return lines;
}

FlowMap material_map(const MaterialValues& material) {
  FlowMap known_to, map;
  for (const MaterialKey& key : material_keys)
    if (key.known_to) known_to.add(std::string(key.name), material.known_to.*key.known_to);
  add_keys(map, material_keys, material);
  if (!known_to.empty()) map.add("known_to", known_to.text());
  return map;
}

std::string curve_text(const PlantCurve& curve) {
  std::string text = "  - name: " + word(curve.name) + "\n";
  text += lines_of("    ", curve_keys, curve);
  const std::string points = joined(curve.points, vector);
  text += "    points: [" + points + "]\n";
  if (!curve.radius.empty()) text += "    radius: " + scalar_or_list(curve.radius) + "\n";
  FlowMap section;
  if (curve.section.kind != SectionKind::circle)
    text += "    section: " + add_keys(section, section_keys, curve.section).text() + "\n";
  const FlowMap material = material_map(curve.material);
  if (!material.empty()) text += "    material: " + material.text() + "\n";
  return text;
}

std::string fruit_text(const PlantFruit& fruit) {
  FlowMap map;
  map.add("name", word(fruit.name)).add(fruit.place);
  add_keys(map, fruit_keys, fruit);
  FlowMap detach;
  add_keys(detach, detach_keys, fruit.detach);
  if (!detach.empty()) map.add("detach", detach.text());
  return map.text();
}

std::string leaf_text(const PlantLeaf& leaf) {
  FlowMap map;
  map.add("name", word(leaf.name)).add(leaf.place);
  return add_keys(map, leaf_keys, leaf).text();
}

std::string mass_text(const PlantMass& mass) {
  FlowMap map;
  return add_keys(map.add(mass.place), mass_keys, mass).text();
}

std::string support_text(const CurvePlace& place) {
  return FlowMap().add(place).text();
}

template <typename Item>
std::string section_text(const std::string& key, const std::vector<Item>& items,
                         std::string (*item_text)(const Item&)) {
  if (items.empty()) return {};
  std::string text = key + ":\n";
  for (const Item& item : items) text += "  - " + item_text(item) + "\n";
  return text;
}

}  // namespace

std::string yaml_word(const std::string& text) {
  return io::yaml_word(text);
}

std::string effect_text(const Effect& effect) {
  FlowMap map;
  map.add("name", word(effect.name));
  for (const auto& [key, values] : effect.numbers) map.add(key, scalar_or_list(values));
  for (const auto& [key, text] : effect.words) map.add(key, word(text));
  if (effect.place) map.add("where", FlowMap().add(*effect.place).text());
  return map.text();
}

std::string plant_text(const PlantFile& plant) {
  std::string text = "format: pedicel-plant\nversion: 1\nname: " + word(plant.name) + "\n";
  text += lines_of("", plant_keys, plant);
  const FlowMap material = material_map(plant.material);
  if (!material.empty()) text += "material: " + material.text() + "\n";
  FlowMap sampling;
  text += "sampling: " + add_keys(sampling, sampling_keys, plant).text() + "\n";
  text += "root: " + vector(plant.root) + "\n";
  text += section_text("supports", plant.supports, support_text);
  text += "curves:\n";
  for (const PlantCurve& curve : plant.curves) text += curve_text(curve);
  text += section_text("fruits", plant.fruits, fruit_text);
  text += section_text("leaves", plant.leaves, leaf_text);
  text += section_text("masses", plant.masses, mass_text);
  text += section_text("effects", plant.effects, effect_text);
  return text;
}

void write_plant_file(const std::filesystem::path& path, const PlantFile& plant) {
  io::write_file_atomically(path, plant_text(plant));
}

}  // namespace pedicel::plant
