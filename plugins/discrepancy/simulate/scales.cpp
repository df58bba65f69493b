#include "plugins/discrepancy/simulate/scales.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

Scales scales_of(const plant::BuiltPlant& built, std::span<const TrialScales> trials) {
  Scales scales;
  for (const double length : built.curve_lengths) scales.length = std::max(scales.length, length);
  for (const cosserat::Element& element : built.model.elements) scales.mass += element.mass;
  const cosserat::Element& root = built.model.elements.front();
  scales.root_stiffness = root.bend_stiffness.head<2>().mean() * 0.5 * root.length / scales.length;
  double moved = 1.0e-3 * scales.length;
  for (const auto& [markers, duration, is_static] : trials) {
    if (!is_static) scales.duration = std::max(scales.duration, duration);
    if (markers.size() > 1 && !is_static)
      scales.sample_time = (markers.time.back() - markers.time.front()) / (markers.size() - 1);
    for (Eigen::Index c = 0; c < markers.value.cols(); ++c) {
      double low = 1e300, high = -1e300;
      for (const double x : markers.value.col(c))
        if (std::isfinite(x)) {
          low = std::min(low, x);
          high = std::max(high, x);
        }
      if (high > low) moved = std::max(moved, 0.5 * (high - low));
    }
  }
  // A cantilever with a force at its tip is bent most at the root, by 3 times its drop / length^2.
  scales.curvature = 3.0 * moved / (scales.length * scales.length);
  return scales;
}

Scales scales_of(const Experiment& experiment) {
  Diagnostics diagnostics;
  const auto built = plant::build_plant(experiment.plant(), {}, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  std::vector<TrialScales> trials;
  trials.reserve(experiment.trials.size());
  for (const Trial& trial : experiment.trials)
    trials.push_back({trial.markers, trial.duration(), trial.is_static});
  return scales_of(*built, trials);
}

}  // namespace pedicel::discrepancy
