#include "pedicel/app/tools/draw_tool.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "pedicel/app/editors/stem_editor.h"
#include "pedicel/app/session/live/organ_place.h"
#include "pedicel/app/ui/widgets.h"

/// Which part of the tool a press is for, and what goes on until the release. Strokes are in
/// draw_stroke.cpp, what is dragged in draw_edit.cpp.
namespace pedicel::app {

bool DrawTool::update(Ui& ui, const SceneFrame& frame) {
  if (!ui.draw.on) {
    if (hand_ != Hand::idle) cancel(ui);
    foot_.reset();
    return false;
  }
  if (hand_ == Hand::idle) {
    foot_ = stem_hit(ui, ui.hover);
    const bool camera = ImGui::GetIO().KeyAlt || ImGui::GetIO().KeyCtrl;
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(0) && !camera) press(ui, frame);
    return true;
  }
  drag(ui, frame);
  if (!ImGui::IsMouseDown(0)) release(ui);
  return true;
}

void DrawTool::press(Ui& ui, const SceneFrame& frame) {
  pressed_at_ = ImGui::GetIO().MousePos;
  travel_ = 0.0f;
  if (ui.draw.thing == DrawThing::trim) {
    hand_ = Hand::trim;
    trim_.begin(pressed_at_);
    return;
  }
  if (ui.draw.thing == DrawThing::tie) {
    if (tie_.begin(ui)) hand_ = Hand::tie;
    return;
  }
  if (press_handle(ui, frame)) return;
  if (point_ = point_under(ui, frame); point_ >= 0) {
    choose_point(ui, point_);
    hand_ = Hand::point;
    ui.session.begin_gesture();
    return;
  }
  if (press_organ(ui, frame)) return;
  if (foot_ && ImGui::GetIO().KeyShift) {
    if (ui.run(Command("insert point",
                       {{"plant", foot_->plant}, {"stem", foot_->stem}, {"at", foot_->at}})))
      choose_curve(ui, foot_->plant, foot_->stem);
    return;
  }
  if (ui.draw.thing == DrawThing::stem) return begin_stroke(ui, frame);
  if (foot_)
    put_organ(ui, *foot_);
  else
    ui.say("Click on a stem to put it there");
}

void DrawTool::drag(Ui& ui, const SceneFrame& frame) {
  ImGuiIO& io = ImGui::GetIO();
  travel_ =
      std::max(travel_, std::hypot(io.MousePos.x - pressed_at_.x, io.MousePos.y - pressed_at_.y));
  switch (hand_) {
    case Hand::idle:
      break;
    case Hand::stroke:
      thicken(io.MouseWheel);
      io.MouseWheel = 0.0f;  // not the camera's now
      extend_stroke(ui, frame);
      break;
    case Hand::point:
      move_point(ui, frame);
      break;
    case Hand::radius:
      move_radius(ui);
      break;
    case Hand::organ:
      move_organ(ui, frame);
      break;
    case Hand::trim:
      trim_.extend(ui, frame, io.MousePos);
      break;
    case Hand::tie:
      tie_.lead(ui, frame, io.MousePos);
      break;
  }
}

void DrawTool::release(Ui& ui) {
  constexpr float click_reach = 4.0f;  // px, that a hand may slip in a click
  const ImVec2 at = ImGui::GetIO().MousePos;
  const bool click = travel_ < click_reach * ui.scale;
  if (hand_ == Hand::stroke && click) {
    stroke_.clear();
    if (foot_) choose_curve(ui, foot_->plant, foot_->stem);
  } else if (hand_ == Hand::stroke) {
    end_stroke(ui);
  } else if (hand_ == Hand::trim) {
    if (foot_ && click) trim_.cut(*foot_);
    trim_.apply(ui);
  } else if (hand_ == Hand::tie) {
    tie_.apply(ui);
  } else {
    ui.session.end_gesture();
    // The rods of a leaf that was moved have other numbers.
    const bool moved = at.x != pressed_at_.x || at.y != pressed_at_.y;
    if (hand_ == Hand::organ && moved && ui.selection.kind == Selection::Kind::element)
      ui.selection = {};
  }
  hand_ = Hand::idle;
}

std::string DrawTool::label(const Ui& ui) const {
  if (hand_ == Hand::stroke) {
    double length = 0.0;
    for (std::size_t i = 1; i < stroke_.size(); ++i)
      length += (stroke_[i].position - stroke_[i - 1].position).norm();
    std::string text = std::to_string(static_cast<int>(std::lround(1e3 * length))) + " mm";
    if (thickness_ != 1.0) text += ", " + number_text(thickness_, 3) + " times as thick";
    return text;
  }
  if (hand_ == Hand::radius) {
    std::string plant;
    const plant::PlantCurve* curve = chosen_curve(ui, plant);
    if (!curve || curve->radius.empty()) return "";
    const auto point = std::min(static_cast<std::size_t>(point_), curve->radius.size() - 1);
    return "radius " + number_text(1e3 * curve->radius[point], 3) + " mm";
  }
  if (hand_ == Hand::trim) {
    const std::size_t cuts = trim_.cuts().size();
    return cuts == 0 ? "" : std::to_string(cuts) + (cuts == 1 ? " stem" : " stems");
  }
  if (hand_ == Hand::tie) return tie_.label();
  if (hand_ == Hand::organ && foot_)
    return foot_->stem + ", " + number_text(100.0 * foot_->at, 3) + " %";
  if (hand_ != Hand::idle || !foot_) return "";
  const char* verb = ui.draw.thing == DrawThing::trim ? "cuts " : "on ";
  return verb + foot_->plant + "/" + foot_->stem;
}

Vec3 DrawTool::label_place() const {
  if (hand_ == Hand::stroke && !stroke_.empty()) return stroke_.back().position;
  if (hand_ == Hand::radius) return handle_.surface;
  if (hand_ == Hand::trim && !trim_.cuts().empty()) return trim_.cuts().back().now_W;
  if (hand_ == Hand::tie) return tie_.place();
  return foot_ ? foot_->now_W : Vec3(Vec3::Zero());
}

bool DrawTool::thicken(double steps) {
  if (hand_ != Hand::stroke) return false;
  thickness_ = std::clamp(thickness_ * std::pow(1.1, steps), 0.1, 10.0);
  return true;
}

bool DrawTool::cancel(Ui& ui) {
  if (hand_ == Hand::idle) return false;
  if (hand_ == Hand::stroke)
    stroke_.clear();
  else if (hand_ == Hand::trim)
    trim_.clear();
  else if (hand_ == Hand::tie)
    tie_.clear();
  else
    ui.session.cancel_gesture();
  hand_ = Hand::idle;
  return true;
}

}  // namespace pedicel::app
