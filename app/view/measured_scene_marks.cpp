#include "app/view/measured_scene_marks.h"

#include "app/draw/drawing.h"
#include "app/session/measured/scene_instant.h"
#include "app/session/session.h"
#include "app/session/session_measured.h"
#include "app/view/measured_marks.h"

namespace pedicel::app {

namespace {

constexpr double bead = 0.006;       // m, of a measured marker; stems are thinner
constexpr double simulated = 0.8;    // of it: seen beside a measured one in the same place
constexpr double arrow_from = 0.01;  // m: shorter errors are lines alone

}  // namespace

void MeasuredSceneMarks::update(ViewState& view, const Session& session) {
  list_.clear();
  list_.ground.reset();
  view.hides_plants = false;
  view.links.clear();
  const MeasuredScene& scene = session.measured().scene();
  if (!scene.experiment()) return;
  const MeasuredView& shown = view.measured;
  const SceneInstant instant = scene_instant_of(
      scene, shown.trial, static_cast<discrepancy::Model>(shown.model), shown.time);
  if (session.measured().has_scene() && shown.shape) {
    scene.arm_at(shown.trial, shown.time, view.links);
    if (!instant.shape.empty()) {
      view.hides_plants = true;
      add_plants(scene, instant);
    }
  }
  add_markers(instant, shown);
}

void MeasuredSceneMarks::add_plants(const MeasuredScene& scene, const SceneInstant& instant) {
  const auto point = [&](int index) { return instant.shape[static_cast<std::size_t>(index)]; };
  for (const ScenePlantShape& shape : scene.shapes()) {
    for (const ShapeCurve& curve : shape.curves) {
      std::vector<render::TubePoint> points;
      for (std::size_t i = 0; i < curve.at.size(); ++i)
        if (const Vec3 place = point(curve.first + static_cast<int>(i)); place.allFinite())
          points.push_back({place, curve.radius[i], render::shadings::stem.colour});
      list_.add_tube(points);
    }
    for (std::size_t f = 0; f < shape.fruits.size(); ++f)
      if (const Vec3 place = point(shape.fruits[f]); place.allFinite())
        list_.spheres.push_back({place, shape.radii[f], render::shadings::tomato});
  }
}

void MeasuredSceneMarks::add_markers(const SceneInstant& instant, const MeasuredView& view) {
  const render::Shading seen{measured_colour, 0.4f, 0.4f};
  const render::Shading said{model_colour(view.model), 0.4f, 0.4f};
  for (const MarkerInstant& one : instant.markers) {
    if (view.markers && one.measured.allFinite())
      list_.spheres.push_back({one.measured, bead, seen});
    if (view.markers && one.simulated.allFinite())
      list_.spheres.push_back({one.simulated, simulated * bead, said});
    if (!view.errors || !one.error().allFinite()) continue;
    const Vec3 to = one.simulated + view.error_scale * one.error();
    list_.lines.push_back({one.simulated, to, measured_colour, 2.0f});
    if ((to - one.simulated).norm() > arrow_from) list_.add_arrow(one.simulated, to, 0.001, seen);
  }
}

void MeasuredSceneMarks::add_to(render::DrawList& list) const {
  add_at(list, list_, Pose{});
}

}  // namespace pedicel::app
