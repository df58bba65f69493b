#include "pedicel/io/atomic_file.h"
#include "pedicel/io/yaml_words.h"
#include "pedicel/plant/plant_file.h"
#include "pedicel/plant/plant_numbers.h"

namespace pedicel::plant {

namespace {

std::string exact(double value) {
  return io::yaml_number(value);
}

std::string word(const std::string& text) {
  return yaml_word(text);
}

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + exact(value);
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

/// Every number of a group that plant_numbers() describes, where it is given.
template <typename Group>
FlowMap numbers_map(const Group& group) {
  FlowMap map;
  for_numbers_of<Group>([&](const PlantNumber& number, auto member) {
    map.add(std::string(number.name()), group.*member);
  });
  return map;
}

FlowMap material_map(const MaterialValues& material) {
  const FlowMap known_to = FlowMap()
                               .add("youngs_modulus", material.known_to.youngs_modulus)
                               .add("density", material.known_to.density)
                               .add("damping_time", material.known_to.damping_time);
  FlowMap map = numbers_map(material);
  if (!known_to.empty()) map.add("known_to", known_to.text());
  return map;
}

FlowMap section_map(const SectionShape& section) {
  FlowMap map;
  if (section.kind == SectionKind::ellipse)
    map.add("kind", "ellipse").add("ratio", section.ratio);
  else
    map.add("kind", "rectangle").add("width", section.width).add("height", section.height);
  return map.add("normal", vector(section.normal));
}

std::string curve_text(const PlantCurve& curve) {
  std::string text = "  - name: " + word(curve.name) + "\n";
  text += "    interpolation: ";
  text += curve.interpolation == Interpolation::linear ? "linear\n" : "smooth\n";
  std::string points;
  for (const Vec3& point : curve.points) points += (points.empty() ? "" : ", ") + vector(point);
  text += "    points: [" + points + "]\n";
  if (!curve.radius.empty()) text += "    radius: " + scalar_or_list(curve.radius) + "\n";
  if (curve.section.kind != SectionKind::circle)
    text += "    section: " + section_map(curve.section).text() + "\n";
  const FlowMap material = material_map(curve.material);
  if (!material.empty()) text += "    material: " + material.text() + "\n";
  return text;
}

std::string fruit_text(const PlantFruit& fruit) {
  FlowMap map;
  map.add("name", word(fruit.name)).add(fruit.place);
  map.add("radius", fruit.radius).add("density", fruit.density);
  const FlowMap detach = numbers_map(fruit.detach);
  if (!detach.empty()) map.add("detach", detach.text());
  return map.text();
}

std::string leaf_text(const PlantLeaf& leaf) {
  FlowMap map;
  map.add("name", word(leaf.name)).add(leaf.place);
  map.add("template", word(leaf.leaf_template)).add("size", leaf.size);
  map.add("normal", vector(leaf.normal));
  if (leaf.direction) map.add("direction", vector(*leaf.direction));
  return map.text();
}

std::string mass_text(const PlantMass& mass) {
  return FlowMap().add(mass.place).add("mass", mass.mass).text();
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
  text += plant.shape == Shape::rest ? "shape: rest\n" : "shape: drawn\n";
  if (plant.look == Look::apple) text += "look: apple\n";
  const FlowMap material = material_map(plant.material);
  if (!material.empty()) text += "material: " + material.text() + "\n";
  text += "sampling: " +
          FlowMap().add("connect", plant.connect).add("distance", plant.distance).text() + "\n";
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
