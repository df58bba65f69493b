#include "plugins/discrepancy/data/places.h"

#include <algorithm>
#include <limits>

#include "engine/geometry/curve.h"

namespace pedicel::discrepancy {

namespace {

geometry::Curve curve_of(const plant::PlantCurve& curve) {
  const std::vector<double> radii(curve.points.size(), 0.0);
  return curve.interpolation == plant::Interpolation::linear
             ? geometry::Curve::linear(curve.points, radii)
             : geometry::Curve::smooth(curve.points, radii);
}

constexpr int pieces = 200;  // of a parent, to find where a branch leaves it

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  double arc = 0.0;  // m from the curve's first point
};

Nearest nearest_on(const geometry::Curve& curve, const Vec3& point) {
  Nearest nearest;
  for (int i = 0; i <= pieces; ++i) {
    const double arc = curve.length() * i / pieces;
    const double distance = (curve.point(arc) - point).norm();
    if (distance < nearest.distance) nearest = {distance, arc};
  }
  return nearest;
}

}  // namespace

Vec3 drawn_point(const plant::PlantCurve& curve, double at) {
  const geometry::Curve c = curve_of(curve);
  return c.point(at * c.length());
}

double drawn_length(const plant::PlantCurve& curve) {
  return curve_of(curve).length();
}

std::vector<MarkerChain> chains_of(const Experiment& experiment) {
  const plant::PlantFile& plant = experiment.plant();
  std::vector<geometry::Curve> curves;
  for (const plant::PlantCurve& curve : plant.curves) curves.push_back(curve_of(curve));
  double nearest_root = std::numeric_limits<double>::infinity();
  for (const plant::PlantCurve& curve : plant.curves)
    for (const Vec3& end : {curve.points.front(), curve.points.back()})
      nearest_root = std::min(nearest_root, (end - plant.root).norm());

  std::vector<MarkerChain> chains;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const Vec3 ends[2] = {plant.curves[c].points.front(), plant.curves[c].points.back()};
    MarkerChain chain;
    chain.curve = static_cast<int>(c);
    chain.length = curves[c].length();
    double best = std::numeric_limits<double>::infinity();
    bool backwards = false;
    for (int e = 0; e < 2; ++e) {
      if ((ends[e] - plant.root).norm() <= nearest_root + 1e-9) {
        chain.rooted = true;
        chain.parent = -1;
        backwards = e == 1;
        break;
      }
      for (std::size_t other = 0; other < curves.size(); ++other) {
        if (other == c) continue;
        const Nearest found = nearest_on(curves[other], ends[e]);
        if (found.distance >= best) continue;
        best = found.distance;
        backwards = e == 1;
        chain.parent = static_cast<int>(other);
        chain.parent_arc = found.arc;
      }
    }
    chain.foot = ends[backwards ? 1 : 0];
    std::vector<std::pair<double, int>> order;
    for (std::size_t m = 0; m < experiment.markers.size(); ++m) {
      const plant::CurvePlace& place = experiment.markers[m].place;
      if (place.curve != plant.curves[c].name) continue;
      order.emplace_back(chain.length * (backwards ? 1.0 - place.at : place.at),
                         static_cast<int>(m));
    }
    std::ranges::sort(order);
    for (const auto& [arc, marker] : order) {
      chain.arc.push_back(arc);
      chain.markers.push_back(marker);
    }
    chains.push_back(chain);
  }
  // Arcs of junctions count from the parent's own foot.
  for (MarkerChain& chain : chains)
    if (chain.parent >= 0) {
      const MarkerChain& parent = chains[chain.parent];
      const Vec3 first = plant.curves[parent.curve].points.front();
      if ((parent.foot - first).norm() > 1e-12) chain.parent_arc = parent.length - chain.parent_arc;
    }
  return chains;
}

}  // namespace pedicel::discrepancy
