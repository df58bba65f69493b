#include "engine/world/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/csv.h"
#include "engine/world/place_settings.h"
#include "engine/world/scene_sections.h"

namespace pedicel::world {

namespace {

std::string expected_names(const std::vector<Parameter>& parameters,
                           const std::vector<WordSetting>& words) {
  std::string names = parameter_names(parameters);
  for (const WordSetting& word : words) names += (names.empty() ? "" : ", ") + word.name;
  return names;
}

void apply_word(const Setting& setting, const std::string& section, const WordSetting& word,
                Diagnostics& diagnostics) {
  const auto found = std::find(word.words.begin(), word.words.end(), setting.text);
  if (found != word.words.end()) {
    *word.value = static_cast<int>(found - word.words.begin());
    return;
  }
  diagnostics.error(setting.where, section + "." + setting.key + " is \"" + setting.text +
                                       "\", expected one of: " + joined(word.words));
}

/// The number that a flag or a number is.
std::optional<double> value_of(const std::string& text) {
  if (text == "true") return 1.0;
  if (text == "false") return 0.0;
  return to_number(text);
}

void apply_number(const Setting& setting, const std::string& section, const Parameter& parameter,
                  Diagnostics& diagnostics) {
  const std::optional<double> value = value_of(setting.text);
  if (!value) {
    diagnostics.error(setting.where, section + "." + setting.key + " is \"" + setting.text +
                                         "\", expected a number (" + parameter.unit + ")");
    return;
  }
  if (const auto refused = set_parameter(parameter, *value))
    diagnostics.error(setting.where, section + "." + *refused);
}

/// `asked` names it in faults.
double checked(const std::string& text, double minimum, double maximum, bool whole,
               const std::string& asked) {
  const std::optional<double> value = to_number(text);
  if (value && *value >= minimum && *value <= maximum && (!whole || *value == std::floor(*value)))
    return *value;
  throw UsageError(asked + " = \"" + text + "\": must be a " + (whole ? "whole " : "") +
                   "number between " + io::format_number(minimum) + " and " +
                   io::format_number(maximum));
}

bool set_scene_number(Scene& scene, const std::string& key, const std::string& text,
                      const std::string& asked) {
  for (const SceneNumber& number : scene_numbers()) {
    if (key != number.key) continue;
    const double value = checked(text, number.minimum, number.maximum, number.whole(), asked + key);
    if (number.whole())
      scene.*std::get<int Scene::*>(number.member) = static_cast<int>(value);
    else
      scene.*std::get<double Scene::*>(number.member) = value;
    return true;
  }
  return false;
}

/// In the place of an earlier one of that key.
void take(std::vector<Setting>& settings, Setting setting) {
  std::erase_if(settings, [&](const Setting& one) { return one.key == setting.key; });
  settings.push_back(std::move(setting));
}

/// "0,0,-9.81" or "[0, 0, -9.81]".
Vec3 vector_of(const std::string& key, const std::string& text) {
  std::string plain;
  for (const char c : text)
    if (c != '[' && c != ']' && c != ' ') plain += c;
  Vec3 value = Vec3::Zero();
  std::size_t start = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = axis < 2 ? plain.find(',', start) : plain.size();
    const auto number =
        end == std::string::npos ? std::nullopt : to_number(plain.substr(start, end - start));
    if (!number || !(std::abs(*number) <= most_gravity))
      throw UsageError(key + " = \"" + text +
                       "\": must be x,y,z, numbers between -100 and 100 m/s2");
    value[axis] = *number;
    start = end + 1;
  }
  return value;
}

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0 && text.size() > prefix.size();
}

void set_on_robot(Scene& scene, const Setting& setting) {
  if (setting.key != "robot.gripper_force")
    throw UsageError(setting.where.file + ": expected robot.gripper_force");
  if (!scene.robot) throw UsageError(setting.where.file + ": the scene has no robot");
  scene.robot->gripper_force =
      checked(setting.text, 0.0, largest_gripper_force, false, setting.where.file);
}

void set_on_plant(Scene& scene, const std::string& rest, Setting setting) {
  for (ScenePlant& plant : scene.plants) {
    if (!starts_with(rest, plant.name + ".")) continue;
    setting.key = rest.substr(plant.name.size() + 1);
    take(plant.set, setting);
    return;
  }
  throw UsageError(setting.where.file + ": the scene has no plant of that name");
}

}  // namespace

std::span<const SceneNumber> scene_numbers() {
  static const SceneNumber all[] = {
      {"duration", "s", 1e-6, 1e6, "Simulated time; also --duration.", &Scene::duration},
      {"dt", "s", 1e-7, 1.0, "Time step; also --dt.", &Scene::dt},
      {"log_rate", "Hz", 1e-3, 1e6, "Rows of log.csv; also --log-rate.", &Scene::log_rate},
      {"seed", "1", 0, 1e9, "Seed of everything random; also --seed.", &Scene::seed},
      {"threads", "1", 1, 256, "Threads for the plants; also --threads.", &Scene::threads}};
  return all;
}

io::Bounds scene_bounds(std::string_view key) {
  const auto all = scene_numbers();
  const auto number = std::ranges::find(all, key, &SceneNumber::key);
  PEDICEL_ASSERT(number != all.end());
  return {number->minimum, number->maximum};
}

std::optional<double> to_number(const std::string& text) {
  double value = 0.0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::array<int, 2> to_picture_size(const std::string& text, const std::string& asked) {
  std::array<int, 2> size{};
  char rest = 0;
  const io::Bounds& sides = sections::picture_sizes;
  if (std::sscanf(text.c_str(), "%dx%d%c", &size[0], &size[1], &rest) != 2 ||
      !io::within(size[0], sides) || !io::within(size[1], sides))
    throw UsageError(asked + " " + text + ": expected WxH in pixels, 16 to 8192 each (1280x720)");
  return size;
}

void apply_settings(const std::vector<Setting>& settings, const std::string& section,
                    const std::vector<Parameter>& parameters, const std::vector<WordSetting>& words,
                    Diagnostics& diagnostics) {
  for (const Setting& setting : settings) {
    const auto word = std::find_if(words.begin(), words.end(),
                                   [&](const WordSetting& w) { return w.name == setting.key; });
    const Parameter* parameter = find_parameter(parameters, setting.key);
    if (word != words.end())
      apply_word(setting, section, *word, diagnostics);
    else if (parameter)
      apply_number(setting, section, *parameter, diagnostics);
    else
      diagnostics.error(setting.where,
                        "unknown key \"" + setting.key + "\" in " + section +
                            ", expected one of: " + expected_names(parameters, words));
  }
}

void apply_override(Scene& scene, const std::string& key, const std::string& value,
                    const std::string& asked) {
  for (VariedNumber& varied : scene.vary) varied.held |= varied.key == key;
  if (set_scene_number(scene, key, value, asked)) return;
  if (set_place(scene, key, value, asked)) return;
  if (key == "gravity") {
    scene.gravity = vector_of(key, value);
    return;
  }
  const Setting setting{key, value, {asked + key, 0, 0}};
  if (starts_with(key, "rods.")) {
    take(scene.rods, {key.substr(5), value, setting.where});
  } else if (starts_with(key, "coupling.")) {
    take(scene.coupling, {key.substr(9), value, setting.where});
  } else if (starts_with(key, "robot.")) {
    set_on_robot(scene, setting);
  } else if (starts_with(key, "plants.")) {
    set_on_plant(scene, key.substr(7), setting);
  } else if (key.find('.') == std::string::npos) {
    throw UsageError(
        setting.where.file +
        ": expected duration, dt, gravity, log_rate, seed, threads, rods.KEY, coupling.KEY, "
        "robot.gripper_force, plants.NAME.KEY, " +
        place_keys() + ", or an override of every plant such as detach.stretch");
  } else {
    for (ScenePlant& plant : scene.plants) take(plant.set, setting);
  }
}

namespace {

/// What a drawn value is called in faults, which come when plants are built: the place that varies.
void place_of_drawn(std::vector<Setting>& settings, const std::string& key,
                    const SourcePosition& where) {
  for (Setting& one : settings)
    if (one.where.file == key && one.where.line == 0) one.where = where;
}

}  // namespace

Scene drawn_scene(const Scene& scene) {
  Scene drawn = scene;
  Diagnostics diagnostics;
  for (const auto& [key, text] : draw(scene.vary, static_cast<std::uint64_t>(scene.seed))) {
    const SourcePosition& where = std::ranges::find(scene.vary, key, &VariedNumber::key)->where;
    try {
      apply_override(drawn, key, text);
    } catch (const UsageError& fault) {
      diagnostics.error(where, std::string("vary: ") + fault.what());
    }
    place_of_drawn(drawn.rods, key, where);
    place_of_drawn(drawn.coupling, key, where);
    for (ScenePlant& plant : drawn.plants) place_of_drawn(plant.set, key, where);
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  drawn.vary.clear();
  return drawn;
}

std::pair<std::string, std::string> split_assignment(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError("\"" + text + "\": expected key=value");
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace pedicel::world
