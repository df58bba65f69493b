#include "plugins/discrepancy/scene_predict/scene_observe.h"

#include <algorithm>

#include "engine/core/random.h"

namespace pedicel::discrepancy {

namespace {

// What was not measured is not observed either; where nothing was, all is still to be measured.
void take(Samples& samples, Eigen::MatrixXd predicted) {
  if (samples.size() == 0) return;
  const bool empty = samples.value.array().isNaN().all();
  samples.value =
      empty ? predicted : samples.value.array().isNaN().select(samples.value, predicted).matrix();
}

class NoiseMaker {
 public:
  explicit NoiseMaker(std::uint64_t seed) : seed_(seed) {}
  void add(Samples& samples, long first, long count, const std::optional<double>& deviation) {
    for (long c = first; c < std::min(first + count, samples.value.cols()); ++c) {
      // Each column has its own stream, so that another one does not change it.
      Random random(Random(seed_ * 100000 + next_++).next());
      if (!deviation) continue;
      for (int s = 0; s < samples.size(); ++s) samples.value(s, c) += *deviation * random.normal();
    }
  }

 private:
  std::uint64_t seed_, next_ = 0;
};

}  // namespace

Experiment observed_scene(Experiment like, const SceneVariant& variant,
                          const SceneObserveOptions& options) {
  std::vector<SceneReadings> found;
  std::vector<Eigen::MatrixXd> encoders;
  {
    SceneSimulator simulator(like, options.numerics, options.threads);
    std::vector<SceneSimulator::Request> requests;
    for (int t = 0; t < static_cast<int>(like.trials.size()); ++t)
      requests.push_back({&variant, t});
    found = simulator.run(requests);
    for (const Trial& trial : like.trials) {
      encoders.emplace_back();
      if (trial.follows_commands) continue;
      const JointPath path = path_of(like, trial);
      Eigen::MatrixXd rows(trial.joints.size(), static_cast<long>(trial.joint_columns.size()));
      for (int s = 0; s < trial.joints.size(); ++s) {
        const Eigen::VectorXd q = path.at(trial.joints.time[static_cast<std::size_t>(s)]).q;
        for (long c = 0; c < rows.cols(); ++c)
          rows(s, c) = q[trial.joint_columns[static_cast<std::size_t>(c)]];
      }
      encoders.back() = std::move(rows);
    }
  }
  NoiseMaker noise(options.seed);
  constexpr long all = 1000000;
  for (std::size_t t = 0; t < found.size(); ++t) {
    Trial& trial = like.trials[t];
    if (!found[t].healthy)
      throw SceneFailed("trial \"" + trial.name + "\" cannot be simulated: lower --dt");
    const StatedNoise stated = options.noise ? like.noise : StatedNoise{};
    take(trial.joints, trial.follows_commands ? found[t].joints : encoders[t]);
    noise.add(trial.joints, 0, all, stated.joint_std);
    take(trial.markers, found[t].markers);
    noise.add(trial.markers, 0, all, stated.position_std);
    for (std::size_t c = 0; c < trial.pixels.size(); ++c) {
      take(trial.pixels[c], found[t].pixels[c]);
      noise.add(trial.pixels[c], 0, all, stated.pixel_std);
    }
    for (std::size_t w = 0; w < trial.wrenches.size(); ++w) {
      take(trial.wrenches[w], found[t].wrenches[w]);
      noise.add(trial.wrenches[w], 0, 3, stated.force_std);
      noise.add(trial.wrenches[w], 3, 3, stated.moment_std);
    }
    take(trial.torques, found[t].torques);
    noise.add(trial.torques, 0, all, stated.torque_std);
    // What drove the model stays; what came off is what the model lost.
    std::erase_if(trial.events, [](const MeasuredEvent& event) {
      return event.event == "detached" || event.event == "slipped";
    });
    trial.events.insert(trial.events.end(), found[t].events.begin(), found[t].events.end());
    std::ranges::stable_sort(trial.events, {}, &MeasuredEvent::time);
  }
  return like;
}

}  // namespace pedicel::discrepancy
