#include "app/bench.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/check.h"
#include "core/timer.h"
#include "cosserat/direct_solver.h"
#include "cosserat/rod_system.h"
#include "plant/reference_plants.h"

namespace pedicel::app {

namespace {

const Vec3 earth(0, 0, -9.81);

// The heavy elastica and the clamped-free beam of the reference cantilever (plant::cantilever).
constexpr double cantilever_drop = 0.227248;      // m
constexpr double cantilever_frequency = 1.10599;  // Hz

std::vector<cosserat::RodModel> plants_of(const std::string& name) {
  std::vector<cosserat::RodModel> plants;
  if (name == "rods_2242")
    for (int p = 0; p < plant::forest_size; ++p) plants.push_back(plant::forest_plant(p));
  else if (name == "tree_2242")
    plants.push_back(plant::hanging_tree());
  else
    throw UsageError("bench \"" + name + "\": expected one of rods_2242, tree_2242");
  return plants;
}

double percentile(std::vector<double> values, double share) {
  const auto place =
      values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// Sags to rest by stepping, with the damping that its frequency suggests, so that the error is the
// stepping solver's own.
double cantilever_error(const BenchOptions& options) {
  cosserat::RodModel model = plant::cantilever(20);
  for (cosserat::Element& element : model.elements) element.mass_damping = 10.0;
  cosserat::RodSystem system(options.rods);
  system.add_plant(model);
  for (int i = 0; i < static_cast<int>(6.0 / options.dt); ++i) system.step(options.dt, earth);
  return -system.state(0).position.back().z() / cantilever_drop - 1.0;
}

// Mean period between upward zero crossings of the tip, let go from the bent shape of a small load.
double frequency_error(const BenchOptions& options) {
  const cosserat::RodModel model = plant::cantilever(20);
  cosserat::RodState bent = cosserat::drawn_state(model);
  cosserat::settle(model, bent, 0.005 * earth);
  cosserat::RodSystem system(options.rods);
  system.add_plant(model);
  system.set_state(0, bent);
  double first = 0.0, last = 0.0, before = bent.position.back().z();
  int crossings = 0;
  for (int i = 1; i <= static_cast<int>(12.0 / options.dt); ++i) {
    system.step(options.dt, Vec3::Zero());
    const double now = system.state(0).position.back().z();
    if (before < 0.0 && now >= 0.0) {
      last = options.dt * (i - now / (now - before));
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  if (crossings < 2) return -1.0;
  return (crossings - 1) / (last - first) / cantilever_frequency - 1.0;
}

}  // namespace

const std::vector<std::string>& bench_names() {
  static const std::vector<std::string> names = {"rods_2242", "tree_2242"};
  return names;
}

BenchResult run_bench(const BenchOptions& options) {
  BenchResult result;
  cosserat::RodSystem system(options.rods, options.threads);
  for (cosserat::RodModel& model : plants_of(options.name)) {
    result.rods += model.size();
    system.add_plant(std::move(model));
  }
  const int warm_up = 10;
  for (int i = 0; i < warm_up; ++i) system.step(options.dt, earth);
  std::vector<double> milliseconds;
  const Timer whole;
  const int steps = std::max(1, static_cast<int>(std::lround(options.duration / options.dt)));
  for (int i = 0; i < steps; ++i) {
    const Timer timer;
    system.step(options.dt, earth);
    milliseconds.push_back(1.0e3 * timer.seconds());
  }
  result.threads = options.threads;
  result.dt = options.dt;
  result.real_time_factor = steps * options.dt / whole.seconds();
  result.ms_per_step_p50 = percentile(milliseconds, 0.50);
  result.ms_per_step_p95 = percentile(milliseconds, 0.95);
  result.cantilever_error = cantilever_error(options);
  result.frequency_error = frequency_error(options);
  StateHash hash;
  system.add_to(hash);
  result.state_hash = hash.value();
  return result;
}

std::string to_json(const BenchResult& r) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(r.state_hash));
  const nlohmann::ordered_json json = {{"rods", r.rods},
                                       {"threads", r.threads},
                                       {"dt", r.dt},
                                       {"real_time_factor", r.real_time_factor},
                                       {"ms_per_step_p50", r.ms_per_step_p50},
                                       {"ms_per_step_p95", r.ms_per_step_p95},
                                       {"cantilever_error", r.cantilever_error},
                                       {"frequency_error", r.frequency_error},
                                       {"state_hash", hash}};
  return json.dump(2);
}

std::string to_text(const BenchResult& r) {
  char text[400];
  std::snprintf(
      text, sizeof text,
      "%d elements, %d thread%s, dt 1/%.0f s: %.2f x real time, %.3f ms a step (p95 %.3f)\n"
      "at these settings: cantilever %+.3f %%, first frequency %+.3f %%\n"
      "state hash %016llx",
      r.rods, r.threads, r.threads == 1 ? "" : "s", 1.0 / r.dt, r.real_time_factor,
      r.ms_per_step_p50, r.ms_per_step_p95, 100.0 * r.cantilever_error, 100.0 * r.frequency_error,
      static_cast<unsigned long long>(r.state_hash));
  return text;
}

}  // namespace pedicel::app
