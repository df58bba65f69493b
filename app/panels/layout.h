#pragma once

#include <imgui.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/panel.h"
#include "app/ui/ui.h"

namespace pedicel::app {

/// Where things stand in the window, px.
struct LayoutAreas {
  ImVec2 scene_min, scene_max;  ///< the picture of the scene
};

/// Draws toolbar, sidebars, drawer and status bar about the scene, and lets their edges be dragged.
class Layout {
 public:
  Layout();
  /// Draws everything but the scene and says where that belongs.
  LayoutAreas draw(Ui& ui);

  const std::vector<std::unique_ptr<Panel>>& panels() const { return panels_; }

 private:
  void dock(Ui& ui, Dock dock, const char* id, const ImVec2& low, const ImVec2& high);
  void give_way(Ui& ui, float width);
  bool has(const Ui& ui, Dock dock) const;
  bool edge(const char* id, const ImVec2& low, const ImVec2& high, bool across, double& size,
            double sign, double least, double most, float scale);

  std::vector<std::unique_ptr<Panel>> panels_;
  std::string asked_;                          // tab that was asked for in the last picture
  Dock last_side_ = Dock::left;                // that was asked for last
  std::optional<Dock> gave_way_;               // to come back in a wider window
  bool had_left_ = false, had_right_ = false;  // in the last picture
};

// The bars, a file each.
void draw_toolbar(Ui& ui);
void draw_status_bar(Ui& ui);
/// Banner, hint, legend and notices over the scene.
void draw_scene_texts(Ui& ui, const LayoutAreas& areas);
/// Windows over everything: files, help, information.
void draw_dialogs(Ui& ui);

}  // namespace pedicel::app
