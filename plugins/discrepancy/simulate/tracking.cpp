#include "plugins/discrepancy/simulate/tracking.h"

#include <algorithm>

namespace pedicel::discrepancy {

Tracking::Tracking(const PlantMaker& maker, const Experiment& experiment, const Trial& trial,
                   double stiffness)
    : samples_(&trial.markers), stiffness_(stiffness) {
  if (!active()) return;
  for (const Marker& marker : experiment.markers) places_.push_back(maker.locate(marker.place));
}

Vec3 Tracking::target(int marker, double t) const {
  const std::vector<double>& time = samples_->time;
  const auto sample = [&](std::ptrdiff_t row) -> Vec3 {
    return samples_->value.row(row).segment<3>(3 * marker).transpose();
  };
  if (t <= time.front()) return sample(0);
  if (t >= time.back()) return sample(samples_->size() - 1);
  const std::ptrdiff_t row = std::upper_bound(time.begin(), time.end(), t) - time.begin() - 1;
  const double share = (t - time[row]) / (time[row + 1] - time[row]);
  // At a sample itself the next one does not count.
  if (share < 1.0e-9) return sample(row);
  return (1.0 - share) * sample(row) + share * sample(row + 1);
}

void Tracking::add_supports(double t, std::vector<cosserat::Support>& supports) const {
  for (std::size_t m = 0; m < places_.size(); ++m) {
    const Vec3 position = target(static_cast<int>(m), t);
    if (position.hasNaN()) continue;
    cosserat::Support spring;
    spring.element = places_[m].element;
    spring.back = places_[m].back;
    spring.position = position;
    spring.position_stiffness = stiffness_;
    supports.push_back(spring);
  }
}

void Tracking::record(const cosserat::RodModel& model, const cosserat::RodState& state, double t,
                      Eigen::Ref<Eigen::RowVectorXd> out) const {
  for (std::size_t m = 0; m < places_.size(); ++m) {
    const Vec3 point = cosserat::point_on(model, state, places_[m].element, places_[m].back);
    const Vec3 pull = stiffness_ * (target(static_cast<int>(m), t) - point);
    out.segment<3>(3 * m) = (pull.hasNaN() ? Vec3(0, 0, 0) : pull).transpose();
  }
}

}  // namespace pedicel::discrepancy
