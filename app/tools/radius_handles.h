#pragma once

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

#include "app/view/scene_mouse.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

/// A handle beside a control point: dragged away from the stem it makes the stem thicker there.
struct RadiusHandle {
  int point = -1;               ///< of the curve; -1: no handle
  double radius = 0.0;          ///< m, there
  Vec3 surface = Vec3::Zero();  ///< m, W, where the stem's outline is in the picture
  Vec3 place = Vec3::Zero();    ///< m, W, of the handle: some pixels off the outline
  ImVec2 at{0, 0};              ///< px, of the handle
  ImVec2 away{1, 0};            ///< unit, from the stem to the handle in the picture
  double metres = 0.0;          ///< m a px at that depth

  /// m, once the handle was dragged from `from` to `to` (px); at least a tenth of a millimetre.
  double dragged(const ImVec2& from, const ImVec2& to) const;
};

/// Two a control point (those that hold a corner have none), across the stem as it is seen. None
/// where the stem is seen along itself, or has no radius of its own.
std::vector<RadiusHandle> radius_handles(const plant::PlantCurve& curve, const Pose& pose_W,
                                         const SceneFrame& frame, double scale);
/// The one under a place of the window; nothing where none is.
std::optional<RadiusHandle> handle_at(const std::vector<RadiusHandle>& handles, const ImVec2& at,
                                      double scale);

}  // namespace pedicel::app
