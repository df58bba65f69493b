#include "pedicel/discrepancy/simulate/observation.h"

#include <algorithm>

#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr double never = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1.0e-9;  // s, by which a sample may lie beyond the last step

Vec3 triple(const Motion::Rows& rows, int row, int index) {
  return rows.row(row).segment<3>(3 * index).transpose();
}

struct Point {
  Vec3 position, velocity;
};

// Cubic Hermite polynomial and its derivative.
Point marker_at(const Motion& motion, const Interval& at, int marker) {
  const Vec3 p0 = triple(motion.position, at.row, marker);
  const Vec3 v0 = triple(motion.velocity, at.row, marker);
  if (at.length == 0.0) return {p0, v0};
  const Vec3 p1 = triple(motion.position, at.row + 1, marker);
  const Vec3 v1 = triple(motion.velocity, at.row + 1, marker);
  const double u = at.share, w = 1.0 - u, h = at.length;
  const Vec3 rise = p1 - p0;
  return {p0 + u * u * (3.0 - 2.0 * u) * rise + h * u * w * (w * v0 - u * v1),
          6.0 * u * w / h * rise + w * (1.0 - 3.0 * u) * v0 - u * (2.0 - 3.0 * u) * v1};
}

Quat turn_at(const Motion& motion, const Interval& at, int marker) {
  const auto row = [&](int r) { return Quat(motion.turn.row(r).segment<4>(4 * marker).data()); };
  if (at.length == 0.0) return row(at.row);
  return row(at.row).slerp(at.share, row(at.row + 1));
}

/// What stands between a point and what the instrument says of it.
class Instrument {
 public:
  Instrument(std::span<const Marker> markers, std::span<const plant::Effect> all) {
    for (const Marker& marker : markers) sensor_.markers.push_back(marker.name);
    sensor_.offset.assign(markers.size(), Vec3::Zero());
    for (const plant::Effect& effect : all) effects::apply_to_sensor(effect, sensor_);
  }

  double delay() const { return sensor_.delay; }
  Vec3 marker(const Motion& motion, const Interval& at, int index) const {
    Vec3 position = marker_at(motion, at, index).position;
    const Vec3& offset = sensor_.offset[index];
    if (!offset.isZero(0.0)) position += turn_at(motion, at, index) * offset;
    return sensor_.frame * position;
  }
  Vec3 force(const Vec3& force) const { return sensor_.gain * force + sensor_.force_offset; }

 private:
  effects::SensorState sensor_;
};

}  // namespace

Interval find_interval(const std::vector<double>& time, double t) {
  if (time.empty() || !(t <= time.back() + rounding)) return {};
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  if (next == time.begin()) return {0, 0.0, 0.0};
  const int row = static_cast<int>(next - time.begin()) - 1;
  if (next == time.end()) return {row, 0.0, 0.0};
  return {row, (t - time[row]) / (time[row + 1] - time[row]), time[row + 1] - time[row]};
}

double latency_of(std::span<const plant::Effect> all) {
  effects::SensorState sensor;
  for (const plant::Effect& effect : all) effects::apply_to_sensor(effect, sensor);
  return sensor.delay;
}

Observed observe(const Motion& motion, std::span<const Marker> markers,
                 std::span<const plant::Effect> effects, std::span<const double> marker_time,
                 std::span<const double> force_time) {
  const Instrument instrument(markers, effects);
  const int count = static_cast<int>(markers.size());
  Observed out;
  out.markers.setConstant(marker_time.size(), 3 * count, never);
  out.marker_velocity = out.markers;
  out.force.setConstant(force_time.size(), 3, never);
  for (int s = 0; s < static_cast<int>(marker_time.size()); ++s) {
    const Interval now = find_interval(motion.time, marker_time[s]);
    const Interval seen = find_interval(motion.time, marker_time[s] - instrument.delay());
    for (int m = 0; m < count; ++m) {
      if (seen.row >= 0)
        out.markers.row(s).segment<3>(3 * m) = instrument.marker(motion, seen, m).transpose();
      if (now.row >= 0)
        out.marker_velocity.row(s).segment<3>(3 * m) =
            marker_at(motion, now, m).velocity.transpose();
    }
  }
  for (int s = 0; s < static_cast<int>(force_time.size()); ++s) {
    const Interval at = find_interval(motion.force_time, force_time[s]);
    if (at.row < 0) continue;
    Vec3 force = triple(motion.force, at.row, 0);
    if (at.length > 0.0)
      force = (1.0 - at.share) * force + at.share * triple(motion.force, at.row + 1, 0);
    out.force.row(s) = instrument.force(force).transpose();
  }
  return out;
}

}  // namespace pedicel::discrepancy
