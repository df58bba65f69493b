#include "app/report/solver_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/stop.h"
#include "engine/io/csv.h"
#include "engine/world/settings.h"

namespace pedicel::app {

namespace {

constexpr int most_substeps = 4096;
constexpr double as_good = 1.1;  // of the direct solver's error

bool is_position_based(const world::Scene& scene) {
  return std::any_of(scene.rods.begin(), scene.rods.end(), [](const world::Setting& setting) {
    return setting.key == "solver" && setting.text == "position_based";
  });
}

/// The runs of a comparison: one scene with its distance and its solver changed.
class Runs {
 public:
  Runs(const world::Scene& scene, const world::Expectation& quantity, const RunOptions& options)
      : scene_(scene), quantity_(quantity), options_(options) {
    options_.out.clear();
    options_.pictures = options_.video = false;
    options_.quiet = true;
  }

  /// `substeps` 0: the direct solver.
  SolverComparison::Speed run(double distance, int substeps) const {
    world::Scene one = scene_of_value(scene_, distance);
    if (substeps > 0) {
      world::apply_override(one, "rods.solver", "position_based");
      world::apply_override(one, "rods.substeps", std::to_string(substeps));
    }
    const SceneResult result = run_scene(one, options_);
    return {substeps > 0 ? "position-based" : "direct", std::max(substeps, 1),
            measured_in(quantity_, result), 0.0, result.real_time_factor()};
  }

 private:
  const world::Scene& scene_;
  const world::Expectation& quantity_;
  RunOptions options_;
};

void say(const SolverComparison& comparison) {
  const SolverComparison::Speed& last = comparison.speeds.back();
  std::fprintf(stderr, "%s, %d sub-step%s: %s %s, error %s, %.2f x real time\n",
               last.solver.c_str(), last.substeps, last.substeps == 1 ? "" : "s",
               comparison.quantity.c_str(), io::format_number(last.measured, 4).c_str(),
               io::format_number(last.error, 3).c_str(), last.real_time_factor);
}

}  // namespace

std::optional<SolverComparison> compare_solvers(const world::Scene& scene,
                                                const std::vector<SweepRun>& runs,
                                                const RunOptions& options) {
  const world::Expectation* quantity = measured_by(scene);
  if (!quantity || runs.empty() || scene.sweep->key != "sampling.distance" ||
      is_position_based(scene))
    return std::nullopt;
  const Runs with(scene, *quantity, options);
  SolverComparison comparison;
  comparison.quantity = quantity->quantity;
  for (const SweepRun& run : runs) {
    if (stop_requested) return std::nullopt;
    comparison.rows.push_back(
        {run.value, measured_in(*quantity, run.result), with.run(run.value, 1).measured});
  }
  const double finest =
      std::min_element(comparison.rows.begin(), comparison.rows.end(),
                       [](const auto& a, const auto& b) { return a.distance < b.distance; })
          ->distance;
  comparison.fine_distance = finest / 8.0;
  comparison.fine = with.run(comparison.fine_distance, 0).measured;
  bool was_good = false;
  for (int substeps = 0; substeps <= most_substeps && !comparison.equal && !stop_requested;
       substeps = std::max(1, 2 * substeps)) {
    SolverComparison::Speed speed = with.run(finest, substeps);
    speed.error = std::abs(speed.measured - comparison.fine);
    comparison.speeds.push_back(speed);
    const bool good = substeps > 0 && speed.error <= as_good * comparison.speeds.front().error;
    comparison.equal = good && was_good;
    was_good = good;
    if (!options.quiet) say(comparison);
  }
  return comparison;
}

std::string to_csv(const SolverComparison& comparison) {
  const auto number = [](double value) { return io::format_number(value); };
  std::string text = "solver,distance_m,substeps_1," + comparison.quantity + ",error_" +
                     comparison.quantity + ",real_time_factor_1\n";
  const auto line = [&](const std::string& solver, double distance, int substeps, double measured,
                        const std::string& rest) {
    text += solver + "," + number(distance) + "," + std::to_string(substeps) + "," +
            number(measured) + "," + rest + "\n";
  };
  for (const SolverComparison::Row& row : comparison.rows) {
    line("direct", row.distance, 1, row.direct, "nan,nan");
    line("position-based", row.distance, 1, row.position_based, "nan,nan");
  }
  line("direct", comparison.fine_distance, 1, comparison.fine, "0,nan");
  for (const SolverComparison::Speed& speed : comparison.speeds)
    line(speed.solver, 8.0 * comparison.fine_distance, speed.substeps, speed.measured,
         number(speed.error) + "," + number(speed.real_time_factor));
  return text;
}

}  // namespace pedicel::app
