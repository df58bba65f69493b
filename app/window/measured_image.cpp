#include "app/window/measured_image.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/session/measured/scene_instant.h"
#include "app/session/session.h"
#include "app/session/session_measured.h"
#include "app/ui/theme.h"
#include "app/view/measured_marks.h"
#include "plugins/discrepancy/scene/camera.h"

namespace pedicel::app {

namespace {

constexpr int edge_points = 16;  // a side: distortion bends it

/// Screen pixels that the plane at z = 1 in front of the camera is wide, by the metre.
double enlargement(const discrepancy::Camera& camera, const ImVec2& size) {
  return std::min(size.x * camera.focal.x() / camera.size[0],
                  size.y * camera.focal.y() / camera.size[1]);
}

void draw_edges(const discrepancy::Camera& camera, const SceneFrame& frame) {
  const double w = camera.size[0], h = camera.size[1];
  const Eigen::Vector2d corners[] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
  std::vector<ImVec2> line;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < edge_points; ++i) {
      const double share = static_cast<double>(i) / edge_points;
      const Eigen::Vector2d way = corners[(side + 1) % 4] - corners[side];
      line.push_back(image_place(camera, frame, corners[side] + share * way));
    }
  ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()),
                                          IM_COL32(40, 46, 52, 200), ImDrawFlags_Closed, 1.5f);
}

}  // namespace

int measured_camera(const Session& session, const std::string& name) {
  const discrepancy::Experiment* experiment = session.measured().scene().experiment();
  if (!experiment) return -1;
  const auto& cameras = experiment->cameras;
  const auto found = std::ranges::find(cameras, name, &discrepancy::Camera::name);
  return found == cameras.end() ? -1 : static_cast<int>(found - cameras.begin());
}

const discrepancy::Camera* looked_through(const Ui& ui) {
  const discrepancy::Experiment* experiment = ui.session.measured().scene().experiment();
  const int camera = ui.view.measured.camera;
  if (!experiment || camera < 0 || camera >= static_cast<int>(experiment->cameras.size()))
    return nullptr;
  return &experiment->cameras[static_cast<std::size_t>(camera)];
}

render::Camera camera_through(const discrepancy::Camera& camera, const ImVec2& size) {
  render::Camera seen;
  seen.eye = camera.X_WC.position;
  seen.target = camera.X_WC * Vec3(0, 0, 1);
  seen.up = camera.X_WC.rotation * Vec3(0, -1, 0);
  // Its principal point is the middle of the place, so that a plain pinhole shows the same.
  seen.field_of_view = 2.0 * std::atan2(0.5 * size.y, enlargement(camera, size));
  return seen;
}

ImVec2 image_place(const discrepancy::Camera& camera, const SceneFrame& frame,
                   const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d at =
      enlargement(camera, frame.size) * discrepancy::direction_of(camera, pixel);
  return {frame.low.x + 0.5f * frame.size.x + static_cast<float>(at.x()),
          frame.low.y + 0.5f * frame.size.y + static_cast<float>(at.y())};
}

void draw_measured_image(const Ui& ui, const SceneFrame& frame) {
  const discrepancy::Camera* camera = looked_through(ui);
  if (!camera) return;
  const MeasuredView& view = ui.view.measured;
  const auto place = [&](const Eigen::Vector2d& pixel) {
    return image_place(*camera, frame, pixel);
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(frame.low, ImVec2(frame.low.x + frame.size.x, frame.low.y + frame.size.y),
                    true);
  draw_edges(*camera, frame);
  const ImU32 seen = ink(measured_colour), said = ink(model_colour(view.model));
  const float ring = 6.0f * ui.scale, cross = 5.0f * ui.scale, width = 2.0f * ui.scale;
  for (const ImageInstant& one :
       image_instant_of(ui.session.measured().scene(), view.trial,
                        static_cast<discrepancy::Model>(view.model), view.camera, view.time)) {
    const bool both = one.measured.allFinite() && one.simulated.allFinite();
    const ImVec2 a = place(one.measured), b = place(one.simulated);
    if (both && view.errors) list.AddLine(a, b, seen, width);
    if (one.measured.allFinite()) list.AddCircle(a, ring, seen, 0, width);
    if (!one.simulated.allFinite()) continue;
    list.AddLine(ImVec2(b.x - cross, b.y), ImVec2(b.x + cross, b.y), said, width);
    list.AddLine(ImVec2(b.x, b.y - cross), ImVec2(b.x, b.y + cross), said, width);
  }
  list.PopClipRect();
}

}  // namespace pedicel::app
