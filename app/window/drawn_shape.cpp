#include "app/window/drawn_shape.h"

#include <algorithm>

#include "core/check.h"
#include "plant/plant_graph.h"
#include "plant/stroke_fit.h"

namespace pedicel::app {

const plant::PlantFile* plant_file(const Session& session, const std::string& name) {
  const int p = session.document().plant_index(name);
  return p < 0 ? nullptr : session.document().plants[static_cast<std::size_t>(p)].file.get();
}

Pose plant_pose(const Session& session, const std::string& name) {
  const int p = session.document().plant_index(name);
  return p < 0 ? Pose{} : session.document().plants[static_cast<std::size_t>(p)].entry.pose;
}

std::optional<geometry::Curve> drawn_curve(const Session& session, const std::string& name,
                                           const std::string& stem) {
  const plant::PlantFile* file = plant_file(session, name);
  const int c = file ? file->curve_index(stem) : -1;
  if (c < 0 || file->curves[static_cast<std::size_t>(c)].points.size() < 2) return {};
  return plant::make_curves(*file)[static_cast<std::size_t>(c)];
}

std::vector<double> taper_radii(const std::vector<Vec3>& points, double largest, double smallest,
                                double start, double end) {
  std::vector<double> arcs = {0.0};
  for (std::size_t i = 1; i < points.size(); ++i)
    arcs.push_back(arcs.back() + (points[i] - points[i - 1]).norm());
  std::vector<double> radii;
  for (const double arc : arcs) {
    const double at = arcs.back() > 0.0 ? arc / arcs.back() : 0.0;
    const double share = std::clamp((at - start) / std::max(end - start, 1e-6), 0.0, 1.0);
    radii.push_back(largest + share * (smallest - largest));
  }
  return radii;
}

std::optional<StemShape> shape_of(const std::vector<Vec3>& stroke_W, const DrawMode& options) {
  std::vector<plant::StrokeSample> samples;
  for (const Vec3& point : stroke_W) samples.push_back({point, 1.0});
  plant::StrokeOptions fit;
  fit.tolerance = options.tolerance;
  fit.corners = options.detect_corners;
  try {
    std::vector<Vec3> points = plant::fit_stroke(samples, fit).points;
    if (points.size() < 2) return {};
    std::vector<double> radii = taper_radii(points, options.radius_max, options.radius_min,
                                            options.taper_start, options.taper_end);
    return StemShape{std::move(points), std::move(radii)};
  } catch (const UsageError&) {
    return {};  // a stroke without extent
  }
}

std::optional<StemPlace> stem_place(const Ui& ui, const Selection& hit) {
  if (hit.kind != Selection::Kind::element || hit.plant < 0 ||
      hit.plant >= static_cast<int>(ui.snapshot->plants.size()))
    return {};
  const cosserat::RodModel& model = *ui.snapshot->plants[static_cast<std::size_t>(hit.plant)].model;
  if (hit.element >= model.size()) return {};
  const int organ = model.elements[static_cast<std::size_t>(hit.element)].organ;
  const std::string name = model.organs[static_cast<std::size_t>(organ)];
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return {};
  StemPlace place{name.substr(0, slash), name.substr(slash + 1), 0.0, hit.place_W, hit.place_W};
  const auto curve = drawn_curve(ui.session, place.plant, place.stem);
  if (!curve) return {};
  // The organ's rods lie in the order of the stem: what comes before the place, over all of it.
  double before = 0.0, whole = 0.0;
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& element = model.elements[static_cast<std::size_t>(e)];
    if (element.organ != organ) continue;
    whole += element.length;
    if (e <= hit.element) before = whole;
  }
  if (whole <= 0.0) return {};
  place.at = std::clamp((before - hit.back) / whole, 0.0, 1.0);
  place.drawn_W = plant_pose(ui.session, place.plant) * curve->point(place.at * curve->length());
  return place;
}

}  // namespace pedicel::app
