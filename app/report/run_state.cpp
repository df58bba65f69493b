#include "app/report/run_state.h"

#include <charconv>
#include <cstdio>

#include "app/report/version.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/yaml.h"
#include "engine/world/settings.h"
#include "plugins/plant/plant_file.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::app {

namespace {

constexpr int version_of_states = 1;

std::string hexadecimal(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::uint64_t read_hash(io::YamlMap& map, const char* key) {
  const auto node = map.required(key);
  std::uint64_t hash = 0;
  if (!node) return hash;
  const std::string text = node->text(key);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  if (text.size() != 16 || error != std::errc{} || end != text.data() + text.size())
    node->error(std::string(key) + " is \"" + text + "\", expected 16 hexadecimal digits");
  return hash;
}

long read_steps(io::YamlMap& map) {
  constexpr double most = 1.0e15;
  return static_cast<long>(map.number("steps", {0.0, most}));
}

void add(StateHash& hash, const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters) hash.add(parameter.get());
}

void add(StateHash& hash, const cosserat::RodModel& model) {
  for (const cosserat::Element& element : model.elements) {
    hash.add(element.stretch_stiffness);
    hash.add(element.bend_stiffness);
    hash.add(element.rest_strain);
    hash.add(element.rest_rotation);
    hash.add(element.mass);
    hash.add(element.damping_time);
  }
  for (const cosserat::Fruit& fruit : model.fruits)
    for (const double limit :
         {fruit.thresholds.stretch, fruit.thresholds.bend, fruit.thresholds.force,
          fruit.thresholds.moment, fruit.thresholds.torsion})
      hash.add(limit);
}

}  // namespace

std::uint64_t model_hash(const simulation::Simulation& simulation) {
  StateHash hash;
  hash.add(simulation.state_hash());
  hash.add(simulation.scene().dt);
  hash.add(simulation.scene().gravity);
  cosserat::RodSettings rods = simulation.assets()->rods;
  coupling::CouplingSettings coupling = simulation.assets()->coupling;
  hash.add(static_cast<std::uint64_t>(rods.solver));
  hash.add(static_cast<std::uint64_t>(rods.integrator));
  add(hash, cosserat::parameters_of(rods));
  add(hash, coupling::parameters_of(coupling));
  for (int p = 0; p < simulation.rods().size(); ++p) add(hash, simulation.rods().model(p));
  return hash.value();
}

namespace {

/// Of all parts that are needed to come to it again: a number that was changed by hand would cost
/// hours before it is seen.
std::string sum_of(const RunState& state) {
  StateHash hash;
  hash.add(state.model);
  hash.add(state.dt);
  hash.add(static_cast<std::uint64_t>(state.steps));
  hash.add(state.state);
  return hexadecimal(hash.value());
}

void check_sum(const io::YamlNode& node, const RunState& state) {
  if (node.text("sum") != sum_of(state))
    node.error(
        "sum: does not agree with the other numbers, expected a state as --save-state "
        "wrote it");
}

}  // namespace

RunState state_of(const simulation::Simulation& simulation, std::uint64_t model) {
  return {
      version() + " (" + git_hash() + ")", simulation.scene().name, model, simulation.scene().dt,
      simulation.world().steps(),          simulation.state_hash()};
}

void write_state(const std::filesystem::path& path, const RunState& state) {
  const auto word = [](const std::string& text) { return plant::yaml_word(text); };
  io::write_file_atomically(
      path, "format: pedicel-state\nversion: " + std::to_string(version_of_states) +
                "\nprogram: " + word(state.program) + "\nscene: " + word(state.scene) +
                "\nmodel: " + word(hexadecimal(state.model)) +
                "\ndt: " + io::exact_number(state.dt) + "\nsteps: " + std::to_string(state.steps) +
                "\nstate: " + word(hexadecimal(state.state)) + "\nsum: " + word(sum_of(state)) +
                "\n");
}

RunState read_state(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  io::YamlMap map(io::load_yaml(path, diagnostics), "a state");
  RunState state;
  if (io::check_format(map, "pedicel-state", version_of_states)) {
    state.program = map.text("program");
    state.scene = map.text("scene");
    state.model = read_hash(map, "model");
    state.dt = map.number("dt", world::scene_bounds("dt"));
    state.steps = read_steps(map);
    state.state = read_hash(map, "state");
    const double most = world::scene_bounds("duration").maximum;
    if (!diagnostics.has_errors() && static_cast<double>(state.steps) * state.dt > most)
      map.error("steps: are " + io::format_number(static_cast<double>(state.steps) * state.dt) +
                " s, expected at most " + io::format_number(most) + " s");
    const auto sum = map.optional("sum");
    if (sum && !diagnostics.has_errors()) check_sum(*sum, state);
    map.finish();
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return state;
}

void go_to_state(simulation::Simulation& simulation, const RunState& state,
                 const std::filesystem::path& path) {
  if (model_hash(simulation) != state.model)
    throw InvalidFile({path.string()}, "was saved of scene \"" + state.scene +
                                           "\" with other plants or settings, expected the scene "
                                           "and the options that it was saved with");
  while (simulation.world().steps() < state.steps) {
    throw_if_stopped();
    simulation.step();
  }
  if (simulation.state_hash() != state.state)
    throw InvalidFile({path.string()},
                      "the run does not come to this state again: robot or files of the scene are "
                      "others now, or the program is (saved by " +
                          state.program + ", this is " + version() + " (" + git_hash() + "))");
}

}  // namespace pedicel::app
