#include "plugins/plant/plant_pick.h"

#include <algorithm>
#include <limits>

#include "engine/geometry/closest_point.h"
#include "plugins/plant/plant_graph.h"

namespace pedicel::plant {

namespace {

constexpr int chords_a_curve = 24;  // at least
constexpr double far_away = 1.0e3;  // m, end of a ray

}  // namespace

StemPicker::StemPicker(const PlantFile& plant) {
  const std::vector<geometry::Curve> curves = make_curves(plant);
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const geometry::Curve& curve = curves[c];
    names_.push_back(plant.curves[c].name);
    lengths_.push_back(curve.length());
    const std::vector<double> arcs = curve.sample_arcs(curve.length() / chords_a_curve);
    for (std::size_t i = 1; i < arcs.size(); ++i)
      chords_.push_back({static_cast<int>(c), arcs[i - 1], arcs[i], curve.radius(arcs[i - 1]),
                         curve.radius(arcs[i]), curve.point(arcs[i - 1]), curve.point(arcs[i])});
  }
}

StemPlace StemPicker::place(const Chord& chord, double share) const {
  StemPlace found;
  found.stem = names_[chord.stem];
  found.at = std::clamp(
      (chord.arc_near + share * (chord.arc_far - chord.arc_near)) / lengths_[chord.stem], 0.0, 1.0);
  found.point = chord.near + share * (chord.far - chord.near);
  found.tangent = (chord.far - chord.near).normalized();
  found.radius = chord.radius_near + share * (chord.radius_far - chord.radius_near);
  return found;
}

std::optional<StemPlace> StemPicker::near_point(const Vec3& point, double reach) const {
  std::optional<StemPlace> best;
  for (const Chord& chord : chords_) {
    const double share = geometry::closest_on_segment(point, chord.near, chord.far);
    StemPlace found = place(chord, share);
    found.distance = std::max(0.0, (point - found.point).norm() - found.radius);
    if (found.distance <= reach && (!best || found.distance < best->distance))
      best = std::move(found);
  }
  return best;
}

std::optional<StemPlace> StemPicker::under_ray(const Vec3& origin, const Vec3& direction,
                                               double reach, double widening) const {
  const Vec3 end = origin + far_away * direction;
  std::optional<StemPlace> best;
  for (const Chord& chord : chords_) {
    const geometry::SegmentPair pair =
        geometry::closest_on_segments(origin, end, chord.near, chord.far);
    StemPlace found = place(chord, pair.t);
    found.distance = std::max(0.0, pair.distance - found.radius);
    found.depth = pair.s * far_away;
    if (found.depth <= 0.0 || found.distance > reach + widening * found.depth) continue;
    const bool nearer = best && (found.distance < best->distance ||
                                 (found.distance == best->distance && found.depth < best->depth));
    if (!best || nearer) best = std::move(found);
  }
  return best;
}

}  // namespace pedicel::plant
