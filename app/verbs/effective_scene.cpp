#include "app/verbs/effective_scene.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "app/session/document/document.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/io/atomic_file.h"
#include "engine/io/yaml_text.h"
#include "engine/world/scene_reader.h"
#include "plugins/simulation/plants/rod_options.h"

namespace pedicel::app {

namespace {

using io::YamlText;
using Settings = std::vector<world::Setting>;

/// Read back as the same bits.
std::string exact(double value) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

std::string quoted(const std::filesystem::path& path) {
  return plant::yaml_word(std::filesystem::absolute(path).lexically_normal().string());
}

/// A lone plant on the ground, as document.cpp makes it.
std::string bare_text(const world::Scene& scene) {
  std::string text =
      "format: pedicel-scene\nversion: 1\npurpose: " + plant::yaml_word(scene.purpose) +
      "\nsee: " + plant::yaml_word(scene.see) + "\nduration: 1\nground: {height: 0}\nplants:\n";
  for (const world::ScenePlant& plant : scene.plants) {
    if (plant.file.empty())
      throw UsageError("--print-scene: plant \"" + plant.name +
                       "\" is no plant file, expected one (the window exports it)");
    text += "  - {name: " + plant::yaml_word(plant.name) + ", file: " + quoted(plant.file) + "}\n";
  }
  return text;
}

void write_numbers(YamlText& text, const world::Scene& scene) {
  text.set({"name"}, plant::yaml_word(scene.name));
  text.set({"duration"}, exact(scene.duration));
  text.set({"dt"}, exact(scene.dt));
  text.set({"log_rate"}, exact(scene.log_rate));
  text.set({"seed"}, std::to_string(scene.seed));
  text.set({"threads"}, std::to_string(scene.threads));
  text.set({"gravity"}, "[" + exact(scene.gravity.x()) + ", " + exact(scene.gravity.y()) + ", " +
                            exact(scene.gravity.z()) + "]");
}

void write_parameters(YamlText& text, const std::string& section,
                      const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters)
    text.set({section, parameter.name}, exact(parameter.get()));
}

void write_settings(YamlText& text, const world::Scene& scene) {
  Diagnostics diagnostics;
  cosserat::RodSettings rods;
  coupling::CouplingSettings coupling;
  simulation::apply_rod_settings(scene.rods, rods, diagnostics);
  simulation::apply_coupling_settings(scene.coupling, coupling, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  const bool direct = rods.solver == cosserat::SolverKind::direct;
  const bool bdf2 = rods.integrator == cosserat::Integrator::bdf2;
  text.set({"rods", "solver"}, direct ? "direct" : "position_based");
  text.set({"rods", "integrator"}, bdf2 ? "bdf2" : "backward_euler");
  write_parameters(text, "rods", cosserat::parameters_of(rods));
  text.set({"coupling", "direction"}, coupling.two_way ? "two_way" : "one_way");
  write_parameters(text, "coupling", coupling::parameters_of(coupling));
}

void write_plant(YamlText& text, const world::ScenePlant& plant, const std::string& index) {
  const auto of = [&](const std::string& key) { return YamlText::Path{"plants", index, key}; };
  if (plant.source != world::ScenePlant::Source::built_in) {
    const bool mtg = plant.source == world::ScenePlant::Source::mtg;
    text.set(of(mtg ? "mtg" : "file"), quoted(plant.file));
    if (!plant.fallback.empty()) text.set(of("fallback"), quoted(plant.fallback));
  }
  for (const world::Setting& one : plant.set) {
    YamlText::Path path = of("set");
    path.push_back(one.key);
    text.set(path, one.text);
  }
}

void write_robot(YamlText& text, const world::SceneRobot& robot) {
  text.set({"robot", "file"}, quoted(robot.file));
  for (const auto& [name, path] : robot.packages)
    text.set({"robot", "packages", name}, quoted(path));
  if (robot.trajectory.empty()) return;
  text.remove({"robot", "waypoints"});
  text.set({"robot", "trajectory"}, quoted(robot.trajectory));
}

void write_video(YamlText& text, const world::SceneVideo& video) {
  text.set({"video", "fps"}, exact(video.fps));
  text.set({"video", "size"},
           "[" + std::to_string(video.size[0]) + ", " + std::to_string(video.size[1]) + "]");
  if (!video.camera.empty()) text.set({"video", "camera"}, plant::yaml_word(video.camera));
}

/// What a sweep is expected to do goes with it.
void write_sweep(YamlText& text, const world::Scene& before, const world::Scene& scene) {
  if (!scene.sweep) text.remove({"sweep"});
  if (scene.sweep) {
    const std::string values = joined(scene.sweep->values, exact);
    text.set({"sweep", "set"}, plant::yaml_word(scene.sweep->key));
    text.set({"sweep", "values"}, "[" + values + "]");
  }
  const bool asked = std::ranges::any_of(scene.expectations, &world::Expectation::over_sweep);
  for (std::size_t e = before.expectations.size(); e > 0; --e)
    if (!asked && before.expectations[e - 1].over_sweep())
      text.erase({"expect"}, static_cast<int>(e) - 1);
}

world::Scene parsed(const std::string& text, const std::filesystem::path& path) {
  Diagnostics diagnostics;
  auto scene = world::parse_scene(text, path, diagnostics);
  if (!scene) throw InvalidFile(diagnostics);
  return std::move(*scene);
}

}  // namespace

std::string effective_scene(const world::Scene& scene) {
  const bool bare = scene.file.empty();
  const std::string before = bare ? bare_text(scene) : io::read_file(scene.file);
  YamlText text(before);
  write_numbers(text, scene);
  write_settings(text, scene);
  for (std::size_t p = 0; p < scene.plants.size(); ++p)
    write_plant(text, scene.plants[p], std::to_string(p));
  if (scene.robot) write_robot(text, *scene.robot);
  write_video(text, scene.video);
  if (!bare) write_sweep(text, parsed(before, scene.file), scene);
  parsed(text.text(), scene.file);  // it is a scene
  return text.text();
}

}  // namespace pedicel::app
