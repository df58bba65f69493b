#pragma once

#include <filesystem>

#include "engine/core/random.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/simulate/simulator.h"
#include "tests/unit/discrepancy/beam_experiment.h"

/// A stem that was pulled aside and let go in two directions, as the program itself would see it.
namespace pedicel::testing {

/// How the measured stem is, and how well it was seen.
struct MeasuredStem {
  std::vector<plant::Effect> effects;  ///< that the nominal plant lacks
  double duration = 0.24;              ///< s
  double noise = 2e-4;                 ///< m, standard deviation
  std::uint64_t seed = 1;

  discrepancy::Experiment experiment() const {
    discrepancy::testing::Beam beam;
    beam.damping_time = 0.01;
    discrepancy::Experiment e = discrepancy::testing::experiment_of(beam, duration, 0.02);
    e.title = "a stem, pulled aside and let go";
    e.noise.position_std = noise;
    e.trials[0].force = {};
    e.trials.push_back(e.trials[0]);
    e.trials[0].name = "along_x", e.trials[1].name = "along_y";
    e.trials[0].use = discrepancy::Trial::Use::fit;
    e.trials[1].use = discrepancy::Trial::Use::check;
    for (int t = 0; t < 2; ++t) {
      Vec3 held(0, 0, beam.length - 0.001);
      held[t] = 0.03;
      e.trials[static_cast<std::size_t>(t)].holds = {
          {discrepancy::testing::on_stem(1.0), discrepancy::testing::resting_at(held), 0.06, {}}};
    }
    observe(e);
    return e;
  }

  /// As a folder; its path.
  std::filesystem::path write(const std::filesystem::path& folder) const {
    discrepancy::write_experiment(folder, experiment());
    return folder;
  }

 private:
  void observe(discrepancy::Experiment& e) const {
    const discrepancy::Variant truth{effects, {}};
    discrepancy::Simulator simulator(e, {0.02, 1.0 / 480}, 1);
    Random random(seed);
    for (std::size_t t = 0; t < e.trials.size(); ++t) {
      const discrepancy::Simulator::Request request{&truth, static_cast<int>(t)};
      Eigen::MatrixXd& seen = e.trials[t].markers.value;
      seen = simulator.run({&request, 1}).front().markers;
      for (double& value : seen.reshaped()) value += noise * random.normal();
    }
  }
};

inline plant::Effect soft_root(double stiffness) {
  return discrepancy::testing::effect("base_compliance", "stiffness", {stiffness});
}

}  // namespace pedicel::testing
