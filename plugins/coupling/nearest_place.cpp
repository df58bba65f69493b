#include "pedicel/coupling/nearest_place.h"

#include <algorithm>
#include <cmath>

namespace pedicel::coupling {

namespace {

constexpr int golden_steps = 12;  // narrow the bracket to 0.3 %
constexpr int trace_steps = 32;
constexpr double slow_share = 0.25;  // of the radius: what moved less cannot have changed sides
constexpr double same_side = 0.5;    // least cosine between the normals of one and the same side

struct Place {
  Vec3 now, before;  // m, C
  double radius;
};

Place place_at(const MovingCapsule& capsule, double f) {
  return {(1.0 - f) * capsule.near_C + f * capsule.far_C,
          (1.0 - f) * capsule.near_before_C + f * capsule.far_before_C,
          (1.0 - f) * capsule.radius_near + f * capsule.radius_far};
}

double gap_at(const geometry::SignedDistance& field, const MovingCapsule& capsule, double f) {
  const Place place = place_at(capsule, f);
  return field.distance(place.now) - place.radius;
}

// The first point on the way of a sample at which its sphere touches.
std::optional<Vec3> entry(const geometry::SignedDistance& field, const Place& place) {
  const Vec3 way = place.now - place.before;
  const double length = way.norm(), near_enough = 1.0e-3 * place.radius;
  double along = 0.0;
  for (int i = 0; i < trace_steps; ++i) {
    const Vec3 point = place.before + along / std::max(length, 1.0e-30) * way;
    const double gap = field.distance(point) - place.radius;
    if (gap <= near_enough) return point;
    along += gap;
    if (!(along < length)) return std::nullopt;
  }
  return std::nullopt;
}

// The plane of entry as the contact of a sample that has left the side from which it came.
std::optional<NearestPlace> crossing(const geometry::SignedDistance& field,
                                     const MovingCapsule& capsule, double f) {
  const Place place = place_at(capsule, f);
  const auto point = entry(field, place);
  if (!point) return std::nullopt;
  NearestPlace found;
  Vec3 normal_now_C;
  const double at_entry = field.distance(*point, &found.normal_C);
  field.distance(place.now, &normal_now_C);
  if (found.normal_C.dot(normal_now_C) >= same_side) return std::nullopt;
  found.fraction = f;
  found.radius = place.radius;
  found.gap = at_entry + found.normal_C.dot(place.now - *point) - place.radius;
  if (!(found.gap < 0.0)) return std::nullopt;
  return found;
}

template <class Cost>
double golden_section(double low, double high, const Cost& cost) {
  constexpr double ratio = 0.6180339887498949;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double cost_a = cost(a), cost_b = cost(b);
  for (int i = 0; i < golden_steps; ++i) {
    if (cost_a <= cost_b) {
      high = b, b = a, cost_b = cost_a;
      cost_a = cost(a = high - ratio * (high - low));
    } else {
      low = a, a = b, cost_a = cost_b;
      cost_b = cost(b = low + ratio * (high - low));
    }
  }
  // The ends themselves are never probed above.
  const double best = cost_a <= cost_b ? a : b, best_cost = std::min(cost_a, cost_b);
  const double cost_low = cost(low), cost_high = cost(high);
  if (cost_low <= best_cost && cost_low <= cost_high) return low;
  return cost_high < best_cost ? high : best;
}

}  // namespace

int sample_count(double length, double feature, int per_feature, int most) {
  if (!(length > 0.0)) return 1;
  if (!std::isfinite(feature)) return 2;
  const double wanted = std::ceil(length * per_feature / std::max(feature, 1.0e-9));
  return 1 + static_cast<int>(std::clamp(wanted, 1.0, most - 1.0));
}

std::optional<NearestPlace> nearest_place(const geometry::SignedDistance& field,
                                          const MovingCapsule& capsule,
                                          const SearchSettings& settings) {
  const double length = (capsule.far_C - capsule.near_C).norm(), motion = capsule.motion();
  const double taper = std::abs(capsule.radius_far - capsule.radius_near);
  // Distances change by at most the way that is gone, so far capsules cost one look.
  const double middle = gap_at(field, capsule, 0.5);
  if (!(middle - 0.5 * (length + taper) <= settings.reach + motion)) return std::nullopt;

  const auto cost = [&](double f) {
    return gap_at(field, capsule, f) + 4.0 * settings.flat * (f - 0.5) * (f - 0.5);
  };
  const int intervals = std::max(1, settings.samples - 1);
  const bool fast = motion > slow_share * std::min(capsule.radius_near, capsule.radius_far);
  std::optional<NearestPlace> crossed;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < settings.samples; ++i) {
    const double f = settings.samples == 1 ? 0.5 : static_cast<double>(i) / intervals;
    const double value = cost(f);
    if (value < least) least = value, best = i;
    const Place place = place_at(capsule, f);
    const double distance = value + place.radius;
    if (!((fast && value <= motion) || distance < 0.0)) continue;
    const auto found = crossing(field, capsule, f);
    if (found && (!crossed || found->gap < crossed->gap)) crossed = found;
  }
  if (crossed) return crossed;

  NearestPlace found;
  found.fraction = 0.5;
  if (settings.samples > 1) {
    const double low = std::max(0.0, (best - 1.0) / intervals);
    const double high = std::min(1.0, (best + 1.0) / intervals);
    found.fraction = golden_section(low, high, cost);
  }
  const Place place = place_at(capsule, found.fraction);
  found.radius = place.radius;
  found.gap = field.distance(place.now, &found.normal_C) - place.radius;
  if (!(found.gap <= settings.reach)) return std::nullopt;
  return found;
}

}  // namespace pedicel::coupling
