#pragma once

#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/random.h"
#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/force/missing_force.h"
#include "tests/unit/discrepancy/beam_experiment.h"

namespace pedicel::discrepancy::testing {

inline constexpr double noise_std = 2e-4;  // m

/// A stem of 0.4 m in ten elements (first frequency 2.9 Hz, 1/tip stiffness 1.7 m/N) that is pulled
/// aside in two directions by known loads and let go, with five markers.
struct BentStem {
  Experiment experiment;

  BentStem() {
    Beam beam;
    beam.damping_time = 0.01;
    experiment = experiment_of(beam, 2.5, 0.02);
    experiment.plant().distance = 0.04;
    experiment.markers.clear();
    for (const double at : {0.2, 0.4, 0.6, 0.8, 1.0})
      experiment.markers.push_back({"m" + std::to_string(at), on_stem(at)});
    Trial trial = experiment.trials.front();
    trial.gravity = Vec3(0, 0, -9.81);
    trial.markers = empty_samples(2.5, 0.02, 15);
    trial.force = {};
    experiment.trials.clear();
    const Vec3 pulls[] = {Vec3(0.03, 0.005, 0), Vec3(-0.012, 0.025, 0)};
    for (const Vec3& pull : pulls) {
      trial.name = "trial_" + std::to_string(experiment.trials.size() + 1);
      trial.loads = {{on_stem(1.0), pull, 0.2, 1.0}};
      experiment.trials.push_back(trial);
    }
  }

  double stem_length() const { return drawn_length(experiment.plant().curves.front()); }

  /// Measures what a stem with `forces` would do, with white noise on top.
  void measure(std::vector<PointForce> forces, std::uint64_t seed) {
    Simulator truth(experiment, {0.04, 1.0 / 480}, 1);
    Variant variant;
    variant.effects = {effect("youngs_modulus", "factor", {1.03})};
    variant.forces = std::move(forces);
    std::vector<Simulator::Request> requests{{&variant, 0}, {&variant, 1}};
    const std::vector<Prediction> seen = truth.run(requests);
    Random random(seed);
    for (std::size_t t = 0; t < seen.size(); ++t) {
      experiment.trials[t].markers.value = seen[t].markers;
      for (double& x : experiment.trials[t].markers.value.reshaped())
        x += noise_std * random.normal();
    }
  }

  /// About a model that is fitted from `start` in so many iterations.
  MissingForce infer(const Hypothesis& start = baseline(), int iterations = 60,
                     double least_evidence = 0.0, std::vector<int> trials = {0, 1},
                     std::vector<int> check = {}) const {
    DataSet data(experiment);
    data.set_noise(white_noise(noise_std), white_noise(1.0));
    Simulator simulator(experiment, {0.04, 1.0 / 480}, 1);
    Evaluator evaluator(simulator, data);
    MissingForceOptions options;
    options.fit.trials = std::move(trials);
    options.check = std::move(check);
    options.least_evidence = least_evidence;
    FitOptions around = options.fit;
    around.iterations = iterations;
    const FitSummary model = fit(evaluator, start, around);
    options.note = [](const std::string& s) {
      if (std::getenv("MISSING_NOTES")) std::puts(s.c_str());
    };
    const MissingForce found = infer_missing_force(evaluator, model, options);
    options.note(found.sentence());
    return found;
  }
};

inline PointForce at(double place, std::function<Vec3(double, const Vec3&, const Vec3&)> law) {
  return {on_stem(place), std::move(law), {}};
}

// 3 mm beside the stem, on one side.
inline PointForce soft_stop() {
  return at(0.7, [](double, const Vec3& x, const Vec3&) -> Vec3 {
    const Vec3 n(0.8, 0.6, 0);
    return 0.15 * std::max(0.0, -0.003 - n.dot(x)) * n;
  });
}

}  // namespace pedicel::discrepancy::testing
