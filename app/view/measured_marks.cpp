#include "app/view/measured_marks.h"

#include <algorithm>
#include <cmath>

#include "app/draw/drawing.h"
#include "app/session/measured/measured_instant.h"
#include "app/session/session.h"
#include "app/session/session_measured.h"
#include "engine/render/colormap.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/plant_graph.h"
#include "plugins/plant/plant_pick.h"

namespace pedicel::app {

namespace {

using discrepancy::Model;
using render::Colour;

constexpr double marker_radius = 0.0035;  // m, on thin stems

/// Beads on a thick stem stand out of it on all sides: a measured one most, so that it is seen over
/// a simulated one in the same place.
struct BeadSizes {
  double measured, simulated;  // m
};
BeadSizes bead_sizes(double stem_radius, bool chosen) {
  const double factor = chosen ? 1.5 : 1.0;
  return {std::max(factor * marker_radius, (chosen ? 1.6 : 1.35) * stem_radius),
          std::max(0.8 * factor * marker_radius, (chosen ? 1.35 : 1.15) * stem_radius)};
}

/// The radius (m) of the stem at each marker.
std::vector<double> stem_radii(const discrepancy::Experiment& experiment) {
  std::vector<double> radii;
  const auto curves = plant::make_curves(experiment.plant());
  for (const discrepancy::Marker& marker : experiment.markers) {
    const int c = plant::find_stem(experiment.plant(), marker.place.curve);
    const auto i = static_cast<std::size_t>(std::max(c, 0));
    radii.push_back(c < 0 ? 0.0 : curves[i].radius(marker.place.at * curves[i].length()));
  }
  return radii;
}

/// The models that are shown, and how far beside the first one.
std::vector<int> shown_models(const MeasuredData& data, const MeasuredView& view) {
  if (!view.side_by_side) return {view.model};
  std::vector<int> models;
  for (int m = 0; m < discrepancy::model_count; ++m)
    if (data.has(static_cast<Model>(m))) models.push_back(m);
  return models;
}

double width_of(const plant::PlantFile& plant) {
  Eigen::AlignedBox3d box;
  for (const plant::PlantCurve& curve : plant.curves)
    for (const Vec3& point : curve.points) box.extend(point);
  return std::max(box.sizes().x(), 0.4 * box.diagonal().norm()) + 0.05;
}

/// Index in the snapshot of the plant that was measured; -1: it is not there.
int plant_of(const Session& session, const Snapshot& snapshot) {
  const int index = session.measured().plant();
  if (index < 0) return -1;
  const auto& name = session.document().plants[static_cast<std::size_t>(index)].entry.name;
  for (std::size_t p = 0; p < snapshot.plants.size(); ++p)
    if (snapshot.plants[p].model->name == name) return static_cast<int>(p);
  return -1;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) most = std::max(most, value);
  return most;
}

}  // namespace

Colour model_colour(int model) {
  constexpr std::array<Colour, discrepancy::model_count> colours = {
      Colour::hex(0x3f86e0), Colour::hex(0x9a6fd0), Colour::hex(0x2fa35a)};
  return colours[static_cast<std::size_t>(std::clamp(model, 0, discrepancy::model_count - 1))];
}

void MeasuredMarks::follow(const Session& session,
                           const std::shared_ptr<const cosserat::RodModel>& model,
                           const Pose& place_W) {
  const MeasuredData& data = session.measured().data();
  if (places_.model == model && places_.number == data.number()) return;
  places_ = {model, data.number(), {}};
  const plant::StemPicker picker(data.experiment()->plant());
  const Pose X_PW = place_W.inverse();
  for (const cosserat::Element& element : model->elements) {
    constexpr double reach = 0.02;  // m; leaves and what is farther off have no residual
    const auto place = picker.near_point(X_PW * element.drawn_position, reach);
    places_.of_element.emplace_back(place ? place->stem : "", place ? place->at : 0.0);
  }
}

void MeasuredMarks::update(ViewState& view, const Session& session, const Snapshot& snapshot) {
  list_.clear();
  list_.ground.reset();
  view.hidden_plant = view.residual_plant = -1;
  const MeasuredData& data = session.measured().data();
  if (!data.experiment()) return;
  const int document = session.measured().plant();
  Pose place_W;
  if (document >= 0)
    place_W = session.document().plants[static_cast<std::size_t>(document)].entry.pose;
  const int plant = plant_of(session, snapshot);
  const TrialPath* path = data.path(static_cast<Model>(view.measured.model), view.measured.trial);
  view.measured.residual_scale = path ? largest(path->marker_rms) : 0.0;
  if (plant >= 0 && path) {
    const auto& model = snapshot.plants[static_cast<std::size_t>(plant)].model;
    follow(session, model, place_W);
    view.residual_plant = plant;
    view.residual.clear();
    for (const auto& [curve, at] : places_.of_element)
      view.residual.push_back(residual_along(*data.experiment(), path->marker_rms, curve, at));
  }
  if (stem_radii_.size() != data.experiment()->markers.size() || radii_of_ != data.number())
    stem_radii_ = stem_radii(*data.experiment()), radii_of_ = data.number();
  const double beside = width_of(data.experiment()->plant());
  for (const int model : shown_models(data, view.measured)) {
    add_model(data, view, model, place_W);
    place_W.position.x() += beside;
  }
  if (view.measured.shape && !list_.tubes.empty()) view.hidden_plant = plant;
}

void MeasuredMarks::add_model(const MeasuredData& data, const ViewState& view, int model,
                              const Pose& place_W) {
  const auto instant =
      instant_of(data, view.measured.trial, static_cast<Model>(model), view.measured.time);
  if (!instant) return;
  if (view.measured.shape) add_shape(data, *instant, view, model, place_W);
  add_markers(*instant, view.measured, model, place_W);
}

void MeasuredMarks::add_shape(const MeasuredData& data, const MeasuredInstant& instant,
                              const ViewState& view, int model, const Pose& place_W) {
  const TrialPath* path = data.path(static_cast<Model>(model), view.measured.trial);
  if (!path || instant.shape.empty()) return;
  const auto& curves = data.experiment()->plant().curves;
  const bool coloured = view.colours == ColourMap::residual && view.measured.residual_scale > 0.0;
  for (const ShapeCurve& curve : data.shape()) {
    std::vector<render::TubePoint> points;
    for (std::size_t i = 0; i < curve.at.size(); ++i) {
      const Vec3& point = instant.shape[static_cast<std::size_t>(curve.first) + i];
      if (!point.allFinite()) continue;
      Colour colour = render::shadings::stem.colour;
      if (coloured)
        colour = render::strain_colour(
            residual_along(*data.experiment(), path->marker_rms,
                           curves[static_cast<std::size_t>(curve.curve)].name, curve.at[i]) /
            view.measured.residual_scale);
      points.push_back({place_W * point, curve.radius[i], colour});
    }
    list_.add_tube(points);
  }
}

void MeasuredMarks::add_markers(const MeasuredInstant& instant, const MeasuredView& view, int model,
                                const Pose& place_W) {
  const render::Shading seen{measured_colour, 0.4f, 0.4f};
  const render::Shading said{model_colour(model), 0.4f, 0.4f};
  for (std::size_t m = 0; m < instant.markers.size(); ++m) {
    const MarkerInstant& one = instant.markers[m];
    const BeadSizes size = bead_sizes(stem_radii_[m], static_cast<int>(m) == view.marker);
    if (view.markers && one.measured.allFinite())
      list_.spheres.push_back({place_W * one.measured, size.measured, seen});
    if (view.markers && one.simulated.allFinite())
      list_.spheres.push_back({place_W * one.simulated, size.simulated, said});
    if (!view.errors || !one.error().allFinite()) continue;
    const Vec3 from = place_W * one.simulated;
    const Vec3 to = place_W * Vec3(one.simulated + view.error_scale * one.error());
    list_.lines.push_back({from, to, measured_colour, 2.0f});
    if ((to - from).norm() > 3.0 * marker_radius) list_.add_arrow(from, to, 0.001, seen);
  }
}

void MeasuredMarks::add_to(render::DrawList& list) const {
  add_at(list, list_, Pose{});
}

}  // namespace pedicel::app
