#include "plugins/discrepancy/simulate/observation.h"

#include <algorithm>

#include "plugins/discrepancy/simulate/first_order_lag.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr double never = std::numeric_limits<double>::quiet_NaN();
constexpr double beyond_the_last = 1.0e-9;  // s, by which a sample may lie beyond the last step

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

// `before` time 0 (s), of what moved then, too.
Vec3 marker_before(const Motion& motion, double before, int marker) {
  const Vec3 p = triple(motion.position, 0, marker), v = triple(motion.velocity, 0, marker);
  if (motion.time.size() < 2) return p - before * v;
  const Vec3 a = (triple(motion.velocity, 1, marker) - v) / (motion.time[1] - motion.time[0]);
  return p - before * v + 0.5 * before * before * a;
}

Quat turn_at(const Motion& motion, const Interval& at, int marker) {
  const auto row = [&](int r) { return Quat(motion.turn.row(r).segment<4>(4 * marker).data()); };
  if (at.length == 0.0) return row(at.row);
  return row(at.row).slerp(at.share, row(at.row + 1));
}

// The slope of the polynomial that marker_at() takes between a row and the next.
LagInput marker_slope(const Motion& motion, int row, int marker) {
  const double h = motion.time[row + 1] - motion.time[row];
  const Vec3 v0 = triple(motion.velocity, row, marker);
  const Vec3 v1 = triple(motion.velocity, row + 1, marker);
  const Vec3 mean =
      (triple(motion.position, row + 1, marker) - triple(motion.position, row, marker)) / h;
  return {v0, (6.0 * mean - 4.0 * v0 - 2.0 * v1) / h, (3.0 * (v0 + v1) - 6.0 * mean) / (h * h)};
}

/// What stands between a point and what the instrument says of it.
class Instrument {
 public:
  Instrument(const Motion& motion, std::span<const Marker> markers,
             std::span<const plant::Effect> all)
      : motion_(motion) {
    for (const Marker& marker : markers) sensor_.markers.push_back(marker.name);
    sensor_.offset.assign(markers.size(), Vec3::Zero());
    for (const plant::Effect& effect : all) effects::apply_to_sensor(effect, sensor_);
    if (sensor_.marker_lag > 0.0) follow_markers();
    if (sensor_.force_lag > 0.0) follow_force();
  }

  double delay() const { return sensor_.delay; }
  Vec3 marker(const Interval& at, double time, int index) const {
    Vec3 position = time < 0.0 && motion_.began_moving ? marker_before(motion_, -time, index)
                                                       : marker_at(motion_, at, index).position;
    const Vec3& offset = sensor_.offset[index];
    if (!offset.isZero(0.0)) position += turn_at(motion_, at, index) * offset;
    if (sensor_.marker_lag > 0.0) position -= marker_behind(at, index);
    return sensor_.frame * position;
  }
  Vec3 force(const Interval& at) const {
    Vec3 force = triple(motion_.force, at.row, 0);
    if (at.length > 0.0)
      force = (1.0 - at.share) * force + at.share * triple(motion_.force, at.row + 1, 0);
    if (sensor_.force_lag > 0.0) force -= force_behind(at);
    return sensor_.gain * force + sensor_.force_offset;
  }

 private:
  // By how much a lagging instrument is behind at each row.
  void follow_markers() {
    const int rows = static_cast<int>(motion_.time.size());
    marker_behind_.setZero(rows, motion_.position.cols());
    for (int row = 0; row + 1 < rows; ++row) {
      const Interval whole{row, 1.0, motion_.time[row + 1] - motion_.time[row]};
      for (int m = 0; m < static_cast<int>(sensor_.markers.size()); ++m)
        marker_behind_.row(row + 1).segment<3>(3 * m) = marker_behind(whole, m).transpose();
    }
  }
  void follow_force() {
    const int rows = static_cast<int>(motion_.force_time.size());
    force_behind_.setZero(rows, 3);
    for (int row = 0; row + 1 < rows; ++row) {
      const double length = motion_.force_time[row + 1] - motion_.force_time[row];
      // Where the force jumps, the instrument has yet to follow.
      const Vec3 jump = triple(motion_.force, row + 1, 0) - triple(motion_.force, row, 0);
      const Vec3 next = length > 0.0 ? force_behind({row, 1.0, length})
                                     : Vec3(triple(force_behind_, row, 0) + jump);
      force_behind_.row(row + 1) = next.transpose();
    }
  }
  Vec3 marker_behind(const Interval& at, int index) const {
    const Vec3 before = triple(marker_behind_, at.row, index);
    if (at.length == 0.0) return before;
    LagInput input = marker_slope(motion_, at.row, index);
    const Vec3& offset = sensor_.offset[index];
    if (!offset.isZero(0.0)) {
      const auto turned = [&](int row) -> Vec3 {
        return turn_at(motion_, {row, 0.0, 0.0}, index) * offset;
      };
      input.constant += (turned(at.row + 1) - turned(at.row)) / at.length;
    }
    return lag_behind(before, sensor_.marker_lag, at.share * at.length, input);
  }
  Vec3 force_behind(const Interval& at) const {
    const Vec3 before = triple(force_behind_, at.row, 0);
    if (at.length == 0.0) return before;
    LagInput input;
    input.constant =
        (triple(motion_.force, at.row + 1, 0) - triple(motion_.force, at.row, 0)) / at.length;
    return lag_behind(before, sensor_.force_lag, at.share * at.length, input);
  }

  const Motion& motion_;
  effects::SensorState sensor_;
  Motion::Rows marker_behind_, force_behind_;  // m, W; N, W
};

}  // namespace

Interval find_interval(const std::vector<double>& time, double t) {
  if (time.empty() || !(t <= time.back() + beyond_the_last)) return {};
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
                 std::span<const double> force_time, std::span<const double> wrench_time) {
  const Instrument instrument(motion, markers, effects);
  const int count = static_cast<int>(markers.size());
  Observed out;
  out.markers.setConstant(marker_time.size(), 3 * count, never);
  out.marker_velocity = out.markers;
  out.force.setConstant(force_time.size(), 3, never);
  for (int s = 0; s < static_cast<int>(marker_time.size()); ++s) {
    const Interval now = find_interval(motion.time, marker_time[s]);
    const double then = marker_time[s] - instrument.delay();
    const Interval seen = find_interval(motion.time, then);
    for (int m = 0; m < count; ++m) {
      if (seen.row >= 0)
        out.markers.row(s).segment<3>(3 * m) = instrument.marker(seen, then, m).transpose();
      if (now.row >= 0)
        out.marker_velocity.row(s).segment<3>(3 * m) =
            marker_at(motion, now, m).velocity.transpose();
    }
  }
  for (int s = 0; s < static_cast<int>(force_time.size()); ++s) {
    const Interval at = find_interval(motion.force_time, force_time[s]);
    if (at.row < 0) continue;
    out.force.row(s) = instrument.force(at).transpose();
  }
  out.wrench.setConstant(wrench_time.size(), 6, never);
  for (int s = 0; s < static_cast<int>(wrench_time.size()) && motion.wrench.size() > 0; ++s) {
    const Interval at = find_interval(motion.force_time, wrench_time[s]);
    if (at.row < 0) continue;
    out.wrench.row(s) = motion.wrench.row(at.row);
    if (at.length > 0.0)
      out.wrench.row(s) +=
          at.share * (motion.wrench.row(at.row + 1) - motion.wrench.row(at.row)).matrix();
  }
  return out;
}

}  // namespace pedicel::discrepancy
