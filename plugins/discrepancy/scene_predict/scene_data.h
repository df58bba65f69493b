#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "plugins/discrepancy/scene_predict/scene_observation.h"
#include "plugins/discrepancy/simulate/misfit.h"

namespace pedicel::discrepancy {

/// What a column of a scene's tables measures; each kind has one noise.
enum class SceneChannel { position, pixel, force, moment, torque, joint };
inline constexpr int scene_channels = 6;
const char* channel_name(SceneChannel kind);

/// Measured less predicted of a scene's trials, in units of the noise (of the instruments, and of
/// the predictions where widen() was called).
class SceneDataSet {
 public:
  /// Deviations as stated; what is not is estimated from third differences of neighbouring samples,
  /// by a part in ten of each column that has few of them. Keeps a reference.
  explicit SceneDataSet(const Experiment& experiment);

  /// Counts samples less where predictions are unsure of themselves: `others` are predictions as
  /// good as `reference`, and how far they are from it adds to the noise of the samples around.
  /// `doubts`: likewise, for another reason, so that both add up.
  void widen(int trial, const SceneReadings& reference, std::span<const SceneReadings> others,
             std::span<const SceneReadings> doubts = {});

  double deviation(SceneChannel kind) const { return deviation_[static_cast<std::size_t>(kind)]; }
  /// Entries of residual() of a trial; those without a measurement are 0.
  int size(int trial) const;
  /// Measured samples of a trial up to `until` (s).
  int samples(int trial, double until) const;
  void residual(int trial, const SceneReadings& readings, double until,
                Eigen::Ref<Eigen::VectorXd> out) const;

  /// Of each entry of residual(), the number of its stretch, from 0 on: what instruments of one
  /// kind say within `length` (s).
  std::vector<int> stretches(int trial, double length) const;

  /// By kind.
  std::array<Misfit, scene_channels> sums(int trial, const SceneReadings& readings) const;
  /// RMS of a residual without the noise's own share: 0 where there is no more than that.
  static double beyond_noise(const Misfit& sum);

 private:
  double weight(int trial, long place) const {
    const auto t = static_cast<std::size_t>(trial);
    return t < weight_.size() && place < weight_[t].size() ? weight_[t][place] : 1.0;
  }

  const Experiment* experiment_;
  std::array<double, scene_channels> deviation_{};
  std::vector<Eigen::VectorXd> weight_;  // 1, by trial, in the order of residual(); or empty
};

}  // namespace pedicel::discrepancy
