#include "app/panels/time_line.h"

#include <algorithm>
#include <cmath>

#include "app/ui/theme.h"
#include "app/ui/widgets.h"

namespace pedicel::app {

namespace {

constexpr float mark_reach = 5.0f;  // points that a mark may be missed by

/// A run of no time yet is shown as a second.
double whole_time(const Ui& ui) {
  return std::max(ui.view.seen.until, 1.0);
}

void go_to(Ui& ui, double time) {
  if (ui.snapshot->mode == RunMode::replaying || ui.snapshot->mode == RunMode::building) return;
  const double dt = ui.snapshot->assets->scene.dt;
  if (std::lround(time / dt) == ui.snapshot->step) return;
  ui.run(Command("go to", {{"time", time}}));
}

const world::Event* event_under(const Ui& ui, float left, float width) {
  const float x = ImGui::GetIO().MousePos.x;
  const world::Event* found = nullptr;
  float least = mark_reach * ui.scale;
  for (const world::Event& event : *ui.view.seen.events) {
    const float at = left + width * static_cast<float>(event.time / whole_time(ui));
    if (std::abs(at - x) > least) continue;
    least = std::abs(at - x);
    found = &event;
  }
  return found;
}

void paint(const Ui& ui, const ImVec2& low, const ImVec2& high, float left, float width) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = 0.5f * (low.y + high.y), half = 2.0f * ui.scale;
  const auto at = [&](double time) {
    return left + width * static_cast<float>(std::min(1.0, time / whole_time(ui)));
  };
  const float now = at(ui.snapshot->time), seen = at(ui.view.seen.until);
  list.AddRectFilled(ImVec2(left, middle - half), ImVec2(left + width, middle + half),
                     colour_u32(palette().line), half);
  list.AddRectFilled(ImVec2(left, middle - half), ImVec2(seen, middle + half),
                     colour_u32(palette().dim, 0.5f), half);
  list.AddRectFilled(ImVec2(left, middle - half), ImVec2(now, middle + half),
                     colour_u32(palette().accent), half);
  for (const world::Event& event : *ui.view.seen.events) {
    const float x = at(event.time), tall = 0.36f * (high.y - low.y);
    list.AddTriangleFilled(ImVec2(x, middle - tall), ImVec2(x - tall, middle + tall),
                           ImVec2(x + tall, middle + tall), colour_u32(palette().error));
  }
  list.AddCircleFilled(ImVec2(now, middle), 0.3f * (high.y - low.y), colour_u32(palette().text));
}

}  // namespace

std::string break_text(const world::Event& event) {
  std::string text = event.organ + " came off at " + number_text(event.time, 4) + " s";
  if (event.cause == "stretch") text += ": strain " + number_text(event.stretch, 3);
  if (event.cause == "bend") text += ": bent by " + number_text(event.bend, 3) + " rad";
  if (event.cause == "moment") text += ": moment " + quantity_text(event.moment, "N m");
  if (event.cause == "torsion") text += ": torsion " + quantity_text(event.torsion, "N m");
  return text + (event.cause == "force" ? ": force " : ", force ") +
         quantity_text(event.force, "N");
}

void follow_run(Ui& ui) {
  static const auto none = std::make_shared<const std::vector<world::Event>>();
  const Snapshot& s = *ui.snapshot;
  SeenRun& seen = ui.view.seen;
  const auto events = s.events ? s.events : none;
  const bool another = seen.stage != s.stage || !seen.events;
  // Played on from an earlier time it is another run from there.
  if (another || s.time >= seen.until || s.mode == RunMode::playing) {
    if (!another && events->size() > seen.breaks && s.mode != RunMode::replaying) {
      const std::size_t more = events->size() - seen.breaks - 1;
      ui.say(break_text(events->back()) + (more ? ", and " + std::to_string(more) + " more" : ""));
    }
    seen = {s.stage, s.time, events->size(), events};
  }
}

float time_line_height(const Ui& ui) {
  return ui.snapshot->assets ? 16.0f * ui.scale : 0.0f;
}

void draw_time_line(Ui& ui, const ImVec2& low, const ImVec2& high) {
  if (!ui.view.seen.events) return;
  const float pad = 10.0f * ui.scale, left = low.x + pad, width = high.x - low.x - 2 * pad;
  if (width < 20.0f) return;
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("time", ImVec2(high.x - low.x, high.y - low.y));
  const world::Event* event =
      ImGui::IsItemHovered() || ImGui::IsItemActive() ? event_under(ui, left, width) : nullptr;
  const double time =
      whole_time(ui) *
      std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - left) / width), 0.0, 1.0);
  if (ImGui::IsItemActive() && time <= ui.view.seen.until) go_to(ui, event ? event->time : time);
  tip(event ? break_text(*event)
            : "Time of the run: click or drag to go back and forth. Triangles: something came off");
  paint(ui, low, high, left, width);
}

}  // namespace pedicel::app
