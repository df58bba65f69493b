#include "session/scene_save.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <string_view>

#include "core/check.h"
#include "io/yaml_text.h"
#include "world/scene_reader.h"
#include "world/settings.h"

namespace pedicel::app {

namespace {

using world::Scene;
using world::ScenePlant;
using world::Setting;

using Values = std::map<std::string, std::string>;

/// Of settings that may come twice the last one counts.
Values values_of(const std::vector<Setting>& settings) {
  Values values;
  for (const Setting& one : settings) values[one.key] = one.text;
  return values;
}

/// Numbers, words and paths as people write them, without quotes where they need none.
std::string plain(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-./+").find(c) != std::string_view::npos;
  };
  const bool begins_well = !text.empty() && (std::isalnum(static_cast<unsigned char>(text[0])) ||
                                             text[0] == '.' || world::to_number(text));
  return begins_well && std::ranges::all_of(text, is_plain) ? text : plant::yaml_word(text);
}

void write_values(io::YamlText& text, const io::YamlText::Path& place, const Values& before,
                  const Values& now) {
  for (const auto& [key, value] : now) {
    const auto held = before.find(key);
    if (held != before.end() && held->second == value) continue;
    io::YamlText::Path path = place;
    path.push_back(key);
    text.set(path, plain(value));
  }
  if (now.empty() && !before.empty()) return text.remove(place);
  for (const auto& [key, value] : before)
    if (!now.count(key)) {
      io::YamlText::Path path = place;
      path.push_back(key);
      text.remove(path);
    }
}

/// Read back as the same bits.
std::string exact(double value) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string list_of(const Vec3& v) {
  return "[" + exact(v.x()) + ", " + exact(v.y()) + ", " + exact(v.z()) + "]";
}

std::string list_of(const std::vector<double>& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "[" : ", ") + exact(value);
  return list + "]";
}

/// As seen from the scene's folder where that is possible.
std::string path_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code none;
  const auto relative = std::filesystem::relative(file, folder, none);
  return plain(
      (none || relative.empty() ? std::filesystem::absolute(file) : relative).generic_string());
}

int index_of(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.plants, name, &ScenePlant::name);
  return found == scene.plants.end() ? -1 : static_cast<int>(found - scene.plants.begin());
}

void write_numbers(io::YamlText& text, const Scene& before, const Scene& now) {
  const auto write = [&](const char* key, double was, double is) {
    if (was != is) text.set({key}, exact(is));
  };
  write("duration", before.duration, now.duration);
  write("dt", before.dt, now.dt);
  write("log_rate", before.log_rate, now.log_rate);
  write("seed", before.seed, now.seed);
  write("threads", before.threads, now.threads);
  if (before.gravity != now.gravity) text.set({"gravity"}, list_of(now.gravity));
}

/// A line a place: such lists are long.
void write_recorded(io::YamlText& text, const Scene& before, const Scene& now) {
  if (!before.robot || !now.robot || before.robot->recorded == now.robot->recorded) return;
  const io::YamlText::Path place = {"robot", "recorded"};
  text.remove(place);
  std::string list;
  for (const world::RecordedPose& pose : now.robot->recorded)
    list += std::string(list.empty() ? "[" : ",") + "\n    {time: " + exact(pose.time) +
            ", joints: " + list_of(pose.joints) + "}";
  if (!list.empty()) text.set(place, list + "]");
}

void write_plant(io::YamlText& text, const std::filesystem::path& folder, const ScenePlant& was,
                 const ScenePlant& is, int index) {
  const std::string number = std::to_string(index);
  if (was.pose.position != is.pose.position)
    text.set({"plants", number, "position"}, list_of(is.pose.position));
  if (is.source == ScenePlant::Source::file && was.file != is.file && !is.file.empty()) {
    if (was.source == ScenePlant::Source::built_in)
      throw UsageError("plant \"" + is.name + "\" is built in, expected it to stay so");
    // What was imported is a plant file now.
    for (const char* key : {"mtg", "optional", "fallback"})
      if (was.source == ScenePlant::Source::mtg) text.remove({"plants", number, key});
    text.set({"plants", number, "file"}, path_from(folder, is.file));
  }
  write_values(text, {"plants", number, "set"}, values_of(was.set), values_of(is.set));
}

void add_plant(io::YamlText& text, const std::filesystem::path& folder, const ScenePlant& plant) {
  if (plant.file.empty())
    throw UsageError("plant \"" + plant.name + "\" has no file yet, expected one before the scene");
  std::string entry =
      "{name: " + plant::yaml_word(plant.name) + ", file: " + path_from(folder, plant.file);
  if (!plant.pose.position.isZero()) entry += ", position: " + list_of(plant.pose.position);
  if (!plant.set.empty()) {
    entry += ", set: {";
    bool first = true;
    for (const auto& [key, value] : values_of(plant.set)) {
      entry += (first ? "" : ", ") + key + ": " + plain(value);
      first = false;
    }
    entry += "}";
  }
  text.append({"plants"}, entry + "}");
}

void write_plants(io::YamlText& text, const Document& document, const Scene& before,
                  const Scene& now) {
  const std::filesystem::path folder = document.path.parent_path();
  for (std::size_t p = 0; p < before.plants.size(); ++p)
    if (const int is = index_of(now, before.plants[p].name); is >= 0)
      write_plant(text, folder, before.plants[p], now.plants[static_cast<std::size_t>(is)],
                  static_cast<int>(p));
  for (std::size_t p = before.plants.size(); p > 0; --p)
    if (index_of(now, before.plants[p - 1].name) < 0 &&
        index_of(*document.scene, before.plants[p - 1].name) >= 0)
      text.erase({"plants"}, static_cast<int>(p) - 1);
  for (const ScenePlant& plant : now.plants)
    if (index_of(before, plant.name) < 0) add_plant(text, folder, plant);
}

bool says(const Scene& read, const Scene& wanted) {
  if (read.dt != wanted.dt || read.gravity != wanted.gravity || read.duration != wanted.duration ||
      read.seed != wanted.seed || values_of(read.rods) != values_of(wanted.rods) ||
      values_of(read.coupling) != values_of(wanted.coupling))
    return false;
  if (read.robot && wanted.robot && read.robot->recorded != wanted.robot->recorded) return false;
  return std::ranges::all_of(wanted.plants, [&](const ScenePlant& plant) {
    const int index = index_of(read, plant.name);
    if (index < 0) return false;
    const ScenePlant& is = read.plants[static_cast<std::size_t>(index)];
    return values_of(is.set) == values_of(plant.set) && is.pose.position == plant.pose.position;
  });
}

/// Without new plants that have no stems yet: there is nothing of them to save.
Scene drawn_scene(const Document& document, const Scene& before) {
  Scene scene = scene_of(document);
  std::erase_if(scene.plants, [&](const ScenePlant& plant) {
    const auto& one = document.plants[static_cast<std::size_t>(document.plant_index(plant.name))];
    return one.file && one.file->curves.empty() && index_of(before, plant.name) < 0;
  });
  return scene;
}

Scene parsed(const std::string& text, const std::filesystem::path& path) {
  Diagnostics diagnostics;
  auto scene = world::parse_scene(text, path, diagnostics);
  if (!scene) throw InvalidFile(diagnostics);
  return std::move(*scene);
}

}  // namespace

std::string changed_scene_text(const Document& document, const std::string& text) {
  const Scene before = parsed(text, document.path);
  const Scene now = drawn_scene(document, before);
  io::YamlText changed(text);
  write_numbers(changed, before, now);
  write_values(changed, {"rods"}, values_of(before.rods), values_of(now.rods));
  write_values(changed, {"coupling"}, values_of(before.coupling), values_of(now.coupling));
  write_recorded(changed, before, now);
  write_plants(changed, document, before, now);
  if (changed.text() != text && !says(parsed(changed.text(), document.path), now))
    throw UsageError(document.path.string() +
                     ": the changes cannot be written into it, expected a scene in plain YAML");
  return changed.text();
}

}  // namespace pedicel::app
