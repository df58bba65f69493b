#pragma once

#include <string>

#include "plugins/discrepancy/simulate/data_set.h"

namespace pedicel::discrepancy {

/// A column of DataSet::scaled_residual(): where it stands in the trial and in a prediction.
struct ChannelPlace {
  const Samples* samples = nullptr;
  Eigen::MatrixXd Prediction::*part = nullptr;
  int column = 0;  ///< of both
  ChannelKind kind = ChannelKind::position;
  std::string name;  ///< "m3.x", "force.z", "root force.x", "root moment.y"
  std::string unit;  ///< "m", "N", "N m"
};
inline ChannelPlace channel_at(const Experiment& experiment, int trial, int number) {
  const Trial& one = experiment.trials[trial];
  const auto markers = static_cast<int>(one.markers.value.cols());
  const auto forces = static_cast<int>(one.force.value.cols());
  const auto axis = [](int column) { return std::string(".") + "xyz"[column % 3]; };
  if (number < markers)
    return {&one.markers,
            &Prediction::markers,
            number,
            ChannelKind::position,
            experiment.markers[number / 3].name + axis(number),
            "m"};
  if (number < markers + forces) {
    const int column = number - markers;
    return {&one.force,         &Prediction::force,     column,
            ChannelKind::force, "force" + axis(column), "N"};
  }
  const int column = number - markers - forces;
  const bool is_force = column < 3;
  return {&one.wrench,
          &Prediction::wrench,
          column,
          is_force ? ChannelKind::force : ChannelKind::moment,
          (is_force ? "root force" : "root moment") + axis(column),
          is_force ? "N" : "N m"};
}

inline const Noise& noise_of(const DataSet& data, ChannelKind kind) {
  return kind == ChannelKind::position ? data.position_noise()
         : kind == ChannelKind::force  ? data.force_noise()
                                       : data.moment_noise();
}

}  // namespace pedicel::discrepancy
