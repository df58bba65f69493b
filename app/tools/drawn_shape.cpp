#include "app/tools/drawn_shape.h"

#include <algorithm>

#include "engine/core/check.h"
#include "plugins/plant/plant_graph.h"

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

std::optional<StemShape> shape_of(const std::vector<plant::StrokeSample>& stroke_W,
                                  const DrawMode& options) {
  double thickest = 1e-3;
  for (const plant::StrokeSample& one : stroke_W) thickest = std::max(thickest, one.pressure);
  std::vector<plant::StrokeSample> samples = stroke_W;
  for (plant::StrokeSample& one : samples) one.pressure /= thickest;
  plant::StrokeOptions fit;
  fit.tolerance = options.tolerance;
  fit.corners = options.detect_corners;
  fit.use_pressure = true;
  fit.radius_from = fit.radius_to = thickest;
  try {
    const plant::FittedStroke fitted = plant::fit_stroke(samples, fit);
    if (fitted.points.size() < 2) return {};
    std::vector<double> radii = taper_radii(fitted.points, options.radius_max, options.radius_min,
                                            options.taper_start, options.taper_end);
    for (std::size_t i = 0; i < radii.size(); ++i) radii[i] *= fitted.radius[i];
    return StemShape{fitted.points, std::move(radii)};
  } catch (const UsageError&) {
    return {};  // a stroke without extent
  }
}

std::optional<StemHit> stem_hit(const Ui& ui, const Selection& hit) {
  if (hit.kind != Selection::Kind::element || hit.plant < 0 ||
      hit.plant >= static_cast<int>(ui.snapshot->plants.size()))
    return {};
  const cosserat::RodModel& model = *ui.snapshot->plants[static_cast<std::size_t>(hit.plant)].model;
  if (hit.element >= model.size()) return {};
  const int organ = model.elements[static_cast<std::size_t>(hit.element)].organ;
  const std::string name = model.organs[static_cast<std::size_t>(organ)];
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return {};
  StemHit place{name.substr(0, slash), name.substr(slash + 1), 0.0, 0.0, hit.place_W, hit.place_W};
  const auto curve = drawn_curve(ui.session, place.plant, place.stem);
  if (!curve) return {};
  // The organ's rods lie from the stem's foot on: what comes before the place, over all of it.
  double before = 0.0, whole = 0.0;
  int tip = hit.element;
  for (int e = 0; e < model.size(); ++e) {
    const cosserat::Element& element = model.elements[static_cast<std::size_t>(e)];
    if (element.organ != organ) continue;
    whole += element.length;
    if (e <= hit.element) before = whole;
    tip = e;
  }
  if (whole <= 0.0) return {};
  place.from_foot = std::clamp((before - hit.back) / whole, 0.0, 1.0);
  const Pose pose = plant_pose(ui.session, place.plant);
  const Vec3 tip_P = pose.inverse() * model.elements[static_cast<std::size_t>(tip)].drawn_position;
  const bool foot_first =
      (tip_P - curve->point(curve->length())).norm() <= (tip_P - curve->point(0.0)).norm();
  place.at = foot_first ? place.from_foot : 1.0 - place.from_foot;
  place.drawn_W = pose * curve->point(place.at * curve->length());
  return place;
}

std::optional<OrganPlace> organ_of(const Ui& ui, const Selection& selection) {
  if (selection.kind != Selection::Kind::fruit && selection.kind != Selection::Kind::element)
    return {};
  const std::string organ = describe(selection, *ui.snapshot);
  const std::size_t slash = organ.find('/');
  if (slash == std::string::npos) return {};
  const std::string plant = organ.substr(0, slash), name = organ.substr(slash + 1);
  const plant::PlantFile* file = plant_file(ui.session, plant);
  if (!file) return {};
  for (const plant::PlantFruit& fruit : file->fruits)
    if (fruit.name == name) return OrganPlace{plant, name, fruit.place, false};
  for (const plant::PlantLeaf& leaf : file->leaves)
    if (leaf.name == name) return OrganPlace{plant, name, leaf.place, true};
  return {};
}

}  // namespace pedicel::app
