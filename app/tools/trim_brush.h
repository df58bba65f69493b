#pragma once

#include <imgui.h>

#include <vector>

#include "app/tools/drawn_shape.h"
#include "app/ui/ui.h"
#include "app/view/scene_mouse.h"
#include "engine/render/draw_list.h"

namespace pedicel::app {

/// A stroke that cuts every stem it crosses in the picture. What is cut off is shown until the
/// button goes up; then it goes, in one step of the history.
class TrimBrush {
 public:
  void begin(const ImVec2& at);
  void extend(const Ui& ui, const SceneFrame& frame, const ImVec2& to);
  /// A click on a stem cuts it there.
  void cut(const StemHit& place);
  void apply(Ui& ui);
  void clear();

  /// One a stem: that nearest to its foot.
  const std::vector<StemHit>& cuts() const { return cuts_; }
  const ImVec2& last() const { return last_; }
  /// The stroke, and what would go, in red.
  void add_to(render::DrawList& list, const Ui& ui, const SceneFrame& frame) const;

 private:
  void add(const StemHit& place);

  ImVec2 last_{0, 0};  // px
  std::vector<ImVec2> way_;
  std::vector<StemHit> cuts_;
};

/// Draws everything that a cut there would take in red, over the plant as it hangs.
void add_beyond(render::DrawList& list, const Snapshot& snapshot, const StemHit& place);

}  // namespace pedicel::app
