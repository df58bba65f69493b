#pragma once

#include "app/ui/ui.h"
#include "app/view/scene_mouse.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::app {

/// Index of a camera of the measured scene that is open; -1: it has none of that name.
int measured_camera(const Session& session, const std::string& name);

/// The measured camera that the scene is looked at through; null: none.
const discrepancy::Camera* looked_through(const Ui& ui);

/// Shows a measured camera's whole picture in a place of that size (px), without its distortion.
render::Camera camera_through(const discrepancy::Camera& camera, const ImVec2& size);

/// Where a place of the measured picture (px) lies in a window that shows it by camera_through().
ImVec2 image_place(const discrepancy::Camera& camera, const SceneFrame& frame,
                   const Eigen::Vector2d& pixel);

/// Over the scene as the measured camera sees it: where it saw the markers, where the model says
/// that it would have, and the edges of its picture. Nothing where no camera is looked through.
void draw_measured_image(const Ui& ui, const SceneFrame& frame);

}  // namespace pedicel::app
