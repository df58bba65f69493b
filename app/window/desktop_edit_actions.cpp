#include <imgui.h>
#include <imgui_internal.h>

#include "pedicel/app/editors/point_editor.h"
#include "pedicel/app/editors/thing_editor.h"
#include "pedicel/app/tools/draw_tool.h"
#include "pedicel/app/window/desktop_actions.h"

/// Actions that change the plants, or what is chosen of them.
namespace pedicel::app {

namespace {

/// Neighbours in the tree of organs: the organ that carries one, or the first that grows from it.
int parent_element(const cosserat::RodModel& model, int element) {
  const int organ = model.elements[static_cast<std::size_t>(element)].organ;
  for (int e = element; e >= 0; e = model.elements[static_cast<std::size_t>(e)].parent)
    if (model.elements[static_cast<std::size_t>(e)].organ != organ) return e;
  return element;
}

int child_element(const cosserat::RodModel& model, int element) {
  const int organ = model.elements[static_cast<std::size_t>(element)].organ;
  for (int e = 0; e < model.size(); ++e) {
    const int parent = model.elements[static_cast<std::size_t>(e)].parent;
    if (parent >= 0 && model.elements[static_cast<std::size_t>(parent)].organ == organ &&
        model.elements[static_cast<std::size_t>(e)].organ != organ)
      return e;
  }
  return element;
}

}  // namespace

void DesktopActions::perform_edit(Action action) {
  const auto walk = [&](auto neighbour) {
    if (ui_.selection.kind != Selection::Kind::element) return;
    const auto& model = *ui_.snapshot->plants[static_cast<std::size_t>(ui_.selection.plant)].model;
    ui_.selection.element = neighbour(model, ui_.selection.element);
    ui_.selection.to_tip = false;
  };
  switch (action) {
    case Action::undo:
      ui_.report(ui_.session.undo());
      break;
    case Action::redo:
      ui_.report(ui_.session.redo());
      break;
    case Action::draw_mode:
      ui_.draw.on = !ui_.draw.on;
      if (ui_.draw.on) ui_.show_panel = "Draw";
      break;
    case Action::point_kind:
      change_point_kind(ui_);
      break;
    case Action::insert_point:
      insert_point(ui_);
      break;
    case Action::smooth:
      smooth_points(ui_);
      break;
    case Action::select_child:
      if (!scene_.draw_tool().thicken(1.0)) walk(child_element);
      break;
    case Action::select_parent:
      if (!scene_.draw_tool().thicken(-1.0)) walk(parent_element);
      break;
    case Action::duplicate:
      duplicate_thing(ui_);
      break;
    case Action::remove:
      if (!remove_thing(ui_)) scene_.draw_tool().remove_selected(ui_);
      break;
    case Action::accept:
      break;
    case Action::cancel:
      if (GImGui->OpenPopupStack.Size > 0)
        ImGui::ClosePopupToLevel(0, false);  // a list, a menu
      else if (ui_.dialog != Dialog::none)
        ui_.dialog = Dialog::none;
      else if (scene_.draw_tool().cancel(ui_))
        break;
      else if (ui_.draw.on)
        ui_.draw.on = false;
      else
        ui_.selection = {};
      break;
    default:
      break;
  }
}

}  // namespace pedicel::app
