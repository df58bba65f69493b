#include "app/tools/tie_stroke.h"

#include <algorithm>
#include <cmath>

#include "app/draw/drawing.h"
#include "app/editors/tie_editor.h"
#include "app/session/live/draw_surface.h"
#include "app/ui/selection_follow.h"
#include "app/ui/widgets.h"
#include "app/view/picking.h"

namespace pedicel::app {

namespace {

using Kind = Selection::Kind;

constexpr double slack_px = 6.0;   // px, that a thin stem may be missed by
constexpr double shortest = 2e-3;  // m

// Files are read by people: 0.0123, not 17 digits.
double rounded(double value, double to) {
  return std::round(value / to) * to + 0.0;  // not -0
}

}  // namespace

std::optional<TieStroke::Foot> TieStroke::foot_of(const Ui& ui, const Selection& hit) {
  if ((hit.kind != Kind::element && hit.kind != Kind::fruit) || hit.plant < 0 ||
      hit.plant >= static_cast<int>(ui.snapshot->plants.size()))
    return {};
  const PlantSnapshot& plant = ui.snapshot->plants[static_cast<std::size_t>(hit.plant)];
  if (hit.element < 0 || hit.element >= plant.model->size()) return {};
  Foot foot{
      describe(hit, *ui.snapshot), {}, point_on(*plant.model, plant.state, hit.element, hit.back)};
  if (hit.kind == Kind::element)
    foot.at = rounded(share_along(*plant.model, hit.element, hit.back), 1e-4);
  return foot;
}

bool TieStroke::begin(Ui& ui) {
  from_ = foot_of(ui, ui.hover);
  moves_.clear();
  if (!from_) {
    ui.say("A string begins on a stem or a fruit: drag from there to where it ends");
    return false;
  }
  to_.reset();
  to_W_ = from_->now_W;
  shapes_.follow(*ui.snapshot);
  return true;
}

void TieStroke::lead(const Ui& ui, const SceneFrame& frame, const ImVec2& to) {
  if (!from_) return;
  const geometry::Ray ray = frame.ray(to);
  const Selection hit = pick(*ui.snapshot, shapes_, ray, frame.angle(slack_px));
  moves_.clear();
  if (hit.kind == Kind::link) moves_ = "the robot";
  if (hit.kind == Kind::body) {
    const BodyInfo& body = *ui.snapshot->bodies[static_cast<std::size_t>(hit.body)].info;
    if (body.description.mass > 0.0) moves_ = body.description.name;
  }
  to_ = foot_of(ui, hit);
  if (to_) {
    to_W_ = to_->now_W;
    return;
  }
  if (hit && hit.kind != Kind::tie) {
    to_W_ = hit.place_W;
    return;
  }
  // A post that is not drawn: in the upright plane of the stem that faces the eye.
  const Vec3 view = frame.camera.target - frame.camera.eye;
  if (const auto at = meet(ray, upright_plane(view, from_->now_W))) to_W_ = *at;
}

void TieStroke::apply(Ui& ui) {
  if (!from_) return;
  const Foot from = *from_;
  const std::optional<Foot> end = to_;
  clear();
  const double way = (to_W_ - from.now_W).norm();
  if (!moves_.empty())
    return ui.say("A string ends at what stands still, and " + moves_ + " moves");
  if (way < shortest) return ui.say("Drag from the stem to where the string ends");
  Vec3 to = to_W_;
  for (double& x : to) x = rounded(x, 1e-6);
  std::map<std::string, Value> arguments{{"organ", from.organ}};
  if (end)
    arguments.emplace("to_organ", end->organ);
  else
    arguments.emplace("to", to);
  if (end && end->at) arguments.emplace("to_at", *end->at);
  if (from.at) arguments.emplace("at", *from.at);
  const DrawMode& d = ui.draw;
  if (d.tie_slack > 0.0) arguments.emplace("length", rounded(way + d.tie_slack, 1e-6));
  if (d.tie_stiffness != world::SceneTie{}.stiffness)
    arguments.emplace("stiffness", d.tie_stiffness);
  if (ui.run(Command("add tie", std::move(arguments))))
    choose_tie(ui, static_cast<int>(ui.session.document().scene->ties.size()) - 1);
}

void TieStroke::add_to(render::DrawList& list) const {
  if (!from_) return;
  constexpr render::Colour held = render::Colour::hex(0xffb020),
                           refused = render::Colour::hex(0xf0402d);
  add_string(list, from_->now_W, to_W_, 0.0, moves_.empty() ? held : refused);
  list.spheres.push_back({to_W_, 0.004, {moves_.empty() ? held : refused, 0.5f, 0.2f}});
}

std::string TieStroke::label() const {
  if (!from_) return "";
  if (!moves_.empty()) return moves_ + " moves";
  return quantity_text((to_W_ - from_->now_W).norm(), "m");
}

}  // namespace pedicel::app
