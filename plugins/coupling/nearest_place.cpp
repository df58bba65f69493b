#include "plugins/coupling/nearest_place.h"

#include <algorithm>
#include <cmath>

namespace pedicel::coupling {

namespace {

// Fixed numbers of steps, and no test for convergence: a place that is found in one step more or
// less would jump between iterates, and Newton's potential with it.
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
  // The radius is subtracted here and not in the field: a tapered capsule has another one at each
  // place.
  const Place place = place_at(capsule, f);
  return field.distance(place.now) - place.radius;
}

// The first point on the way of a sample at which its sphere touches.
// Sphere tracing (Hart 1996): the distance is how far one can go without meeting anything. In C the
// collider rests, so the way is a straight line within a step.
std::optional<Vec3> entry(const geometry::SignedDistance& field, const Place& place) {
  const Vec3 way = place.now - place.before;
  const double length = way.norm(), near_enough = 1.0e-3 * place.radius;
  double along = 0.0;
  for (int i = 0; i < trace_steps; ++i) {
    const Vec3 point = place.before + along / std::max(length, 1.0e-30) * way;
    const double gap = field.distance(point) - place.radius;
    // Within a thousandth of the radius. Nearer, the steps get as short as the gap, and never end.
    if (gap <= near_enough) return point;
    along += gap;
    // Turned round, so that a NaN ends it.
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
  // The normal where it came in. Where it is now, the field may point out of the far side, and the
  // contact would help it through.
  const double at_entry = field.distance(*point, &found.normal_C);
  field.distance(place.now, &normal_now_C);
  // Within 60 degrees it is still the same side, and the nearest place, which follows the surface,
  // is the better contact.
  if (found.normal_C.dot(normal_now_C) >= same_side) return std::nullopt;
  found.fraction = f;
  found.radius = place.radius;
  found.gap = at_entry + found.normal_C.dot(place.now - *point) - place.radius;
  // Back out in front of the plane of entry it is no crossing any more, and needs no push.
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
  // A stem's end on an edge is a common contact, and the bracket only comes near to it.
  const double best = cost_a <= cost_b ? a : b, best_cost = std::min(cost_a, cost_b);
  const double cost_low = cost(low), cost_high = cost(high);
  if (cost_low <= best_cost && cost_low <= cost_high) return low;
  return cost_high < best_cost ? high : best;
}

}  // namespace

int sample_count(double length, double feature, int per_feature, int most) {
  if (!(length > 0.0)) return 1;
  // Along a plane distances are linear, so the least is at an end.
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
  // Lipschitz: |d(a) - d(b)| <= |a - b|. From the middle no end is farther than half of the length,
  // and no radius differs by more than half of the taper.
  const double middle = gap_at(field, capsule, 0.5);
  if (!(middle - 0.5 * (length + taper) <= settings.reach + motion)) return std::nullopt;

  const auto cost = [&](double f) {
    // The parabola is `flat` at both ends. Without it all places of a capsule that lies flat are as
    // near, rounding decides, and the contact jumps from end to end.
    return gap_at(field, capsule, f) + 4.0 * settings.flat * (f - 0.5) * (f - 0.5);
  };
  const int intervals = std::max(1, settings.samples - 1);
  // Following a way costs many looks at the field, so only for what could have changed sides: what
  // moved far, or what has its axis inside now.
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
  // Before the nearest place: from the far side that one is the way out at the back.
  if (crossed) return crossed;

  NearestPlace found;
  found.fraction = 0.5;
  if (settings.samples > 1) {
    // Between the neighbours of the nearest sample there is one least, where samples are dense
    // enough for the collider's smallest part.
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
