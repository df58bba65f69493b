#include "app/bench/bench.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/bench/process_memory.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "engine/core/ring_down.h"
#include "engine/core/timer.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/plant/reference_plants.h"

namespace pedicel::app {

namespace {

// The heavy elastica and the clamped-free beam of the reference cantilever (plant::cantilever).
constexpr double cantilever_drop = 0.227248;      // m
constexpr double cantilever_frequency = 1.10599;  // Hz

// About critical for the first mode of the cantilever and of the forest's plants, so that they
// settle within a second; where they settle does not depend on it.
constexpr double settling_damping = 14.0;  // 1/s

// s, wall: less says more about what else the machine does. Runs are repeated until then.
constexpr double shortest_bench = 0.5;

// Plants of a row, by bench name.
constexpr std::pair<const char*, int> rows[] = {
    {"row_1k", 17}, {"row_10k", 170}, {"row_100k", 1695}};

std::vector<cosserat::RodModel> forest_plants(int count) {
  std::vector<cosserat::RodModel> plants;
  for (int p = 0; p < count; ++p) plants.push_back(plant::forest_plant(p));
  return plants;
}

void step_for(cosserat::RodSystem& system, double seconds, double dt, const Vec3& gravity) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) system.step(dt, gravity);
}

double percentile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

void damp(cosserat::RodModel& model) {
  for (cosserat::Element& element : model.elements) element.mass_damping = settling_damping;
}

// Sags to rest by stepping, so that the error is the stepping solver's own.
double cantilever_error(const BenchOptions& options, int elements) {
  cosserat::RodModel model = plant::cantilever(elements);
  damp(model);
  cosserat::RodSystem system(options.rods);
  system.add_plant(model);
  step_for(system, 4.0, options.dt, bench_gravity);
  return -system.state(0).position.back().z() / cantilever_drop - 1.0;
}

// The cantilever's tip, let go without gravity from the bent shape of a small load.
std::optional<RingDown> cantilever_ring(const BenchOptions& options) {
  const cosserat::RodModel model = plant::cantilever(20);
  cosserat::RodState bent = cosserat::drawn_state(model);
  cosserat::settle(model, bent, 0.005 * bench_gravity);
  cosserat::RodSystem system(options.rods);
  system.add_plant(model);
  system.set_state(0, bent);
  std::vector<double> tip;
  for (int i = 0; i < static_cast<int>(10.0 / options.dt); ++i) {
    system.step(options.dt, Vec3::Zero());
    tip.push_back(system.state(0).position.back().z());
  }
  return ring_down(tip, options.dt);
}

double forest_droop(const BenchOptions& options) {
  cosserat::RodSystem system(options.rods, options.threads);
  for (cosserat::RodModel& model : forest_plants(plant::forest_size)) {
    damp(model);
    add_bench_plant(system, std::move(model), options);
  }
  step_for(system, 1.5, options.dt, bench_gravity);
  double sum = 0.0;
  int ends = 0;
  for (int p = 0; p < system.size(); ++p) {
    const cosserat::RodModel& model = system.model(p);
    std::vector<bool> is_end(model.elements.size(), true);
    for (const cosserat::Element& element : model.elements)
      if (element.parent >= 0) is_end[element.parent] = false;
    for (int e = 0; e < model.size(); ++e) {
      if (!is_end[e]) continue;
      sum += system.state(p).position[e].z() - model.elements[e].drawn_position.z();
      ++ends;
    }
  }
  return sum / ends;
}

BenchAccuracy measure_accuracy(const BenchOptions& options) {
  BenchAccuracy accuracy;
  accuracy.cantilever_error = cantilever_error(options, 20);
  accuracy.cantilever_error_40 = cantilever_error(options, 40);
  if (const auto ring = cantilever_ring(options)) {
    accuracy.frequency_error = ring->frequency / cantilever_frequency - 1.0;
    accuracy.damping_ratio = ring->damping_ratio;
  }
  accuracy.forest_droop = forest_droop(options);
  return accuracy;
}

std::string percent(const std::optional<double>& share) {
  if (!share) return "none (no oscillation)";
  char text[32];
  std::snprintf(text, sizeof text, "%+.3f %%", 100.0 * *share);
  return text;
}

}  // namespace

const std::vector<std::string>& bench_names() {
  static const std::vector<std::string> names = {"rods_2242", "tree_2242", "row_1k", "row_10k",
                                                 "row_100k"};
  return names;
}

std::vector<cosserat::RodModel> bench_plants(const std::string& name) {
  if (name == "rods_2242") return forest_plants(plant::forest_size);
  if (name == "tree_2242") return {plant::hanging_tree()};
  for (const auto& [row, plants] : rows)
    if (name == row) return forest_plants(plants);
  throw UsageError("bench \"" + name + "\": expected one of " + joined(bench_names()) +
                   ", or a scene file (*.scene.yaml)");
}

void add_bench_plant(cosserat::RodSystem& system, cosserat::RodModel model,
                     const BenchOptions& options) {
  const int plant = system.add_plant(std::move(model));
  if (options.self_contact)
    system.add_contact_source(plant, std::make_unique<cosserat::SelfContact>(
                                         system.model(plant), cosserat::SelfContactSettings{}));
}

BenchResult run_bench(const BenchOptions& options) {
  BenchResult result;
  std::vector<cosserat::RodModel> plants = bench_plants(options.name);
  for (const cosserat::RodModel& model : plants) result.rods += model.size();
  const int warm_up = 10;
  const int steps = std::max(1, static_cast<int>(std::lround(options.duration / options.dt)));
  std::vector<double> milliseconds;
  double seconds = 0.0;
  const Timer all;
  do {
    const double before = resident_bytes();
    cosserat::RodSystem system(options.rods, options.threads);
    for (const cosserat::RodModel& model : plants) add_bench_plant(system, model, options);
    for (int i = 0; i < warm_up; ++i) system.step(options.dt, bench_gravity);
    if (milliseconds.empty()) result.bytes_per_element = (resident_bytes() - before) / result.rods;
    const Timer whole;
    for (int i = 0; i < steps; ++i) {
      const Timer timer;
      system.step(options.dt, bench_gravity);
      milliseconds.push_back(1.0e3 * timer.seconds());
    }
    seconds += whole.seconds();
    StateHash hash;
    system.add_to(hash);
    result.state_hash = hash.value();
  } while (all.seconds() < shortest_bench);
  const auto count = static_cast<double>(milliseconds.size());
  result.threads = options.threads;
  result.dt = options.dt;
  result.real_time_factor = count * options.dt / seconds;
  result.ms_per_step_p50 = percentile(milliseconds, 0.50);
  result.ms_per_step_p95 = percentile(milliseconds, 0.95);
  result.ns_per_element_step = 1.0e9 * seconds / count / result.rods;
  result.peak_megabytes = peak_megabytes();
  if (options.accuracy) result.accuracy = measure_accuracy(options);
  return result;
}

std::string hexadecimal(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

std::string to_json(const BenchResult& r) {
  nlohmann::ordered_json json = {{"rods", r.rods},
                                 {"threads", r.threads},
                                 {"dt", r.dt},
                                 {"real_time_factor", r.real_time_factor},
                                 {"ms_per_step_p50", r.ms_per_step_p50},
                                 {"ms_per_step_p95", r.ms_per_step_p95},
                                 {"ns_per_element_step", r.ns_per_element_step},
                                 {"bytes_per_element", r.bytes_per_element},
                                 {"peak_megabytes", r.peak_megabytes},
                                 {"cantilever_error", nullptr},
                                 {"cantilever_error_40", nullptr},
                                 {"frequency_error", nullptr},
                                 {"damping_ratio", nullptr},
                                 {"forest_droop", nullptr},
                                 {"state_hash", hexadecimal(r.state_hash)}};
  if (r.accuracy) {
    json["cantilever_error"] = r.accuracy->cantilever_error;
    json["cantilever_error_40"] = r.accuracy->cantilever_error_40;
    if (r.accuracy->frequency_error) json["frequency_error"] = *r.accuracy->frequency_error;
    if (r.accuracy->damping_ratio) json["damping_ratio"] = *r.accuracy->damping_ratio;
    json["forest_droop"] = r.accuracy->forest_droop;
  }
  return json.dump(2);
}

std::string to_text(const BenchResult& r) {
  char line[300];
  std::snprintf(line, sizeof line,
                "%d elements, %d thread%s, dt 1/%.0f s: %.2f x real time, %.3f ms a step "
                "(p95 %.3f), %.0f ns an element and step, %.0f bytes an element\n",
                r.rods, r.threads, r.threads == 1 ? "" : "s", 1.0 / r.dt, r.real_time_factor,
                r.ms_per_step_p50, r.ms_per_step_p95, r.ns_per_element_step, r.bytes_per_element);
  std::string text = line;
  if (const auto& a = r.accuracy) {
    std::snprintf(line, sizeof line, "; forest droop %.3f mm\n", 1.0e3 * a->forest_droop);
    text += "at these settings: cantilever " + percent(a->cantilever_error) +
            ", with 40 elements " + percent(a->cantilever_error_40) + "; first frequency " +
            percent(a->frequency_error) + ", its numerical damping " + percent(a->damping_ratio) +
            line;
  }
  return text + "state hash " + hexadecimal(r.state_hash);
}

}  // namespace pedicel::app
