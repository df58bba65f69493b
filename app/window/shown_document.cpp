#include "app/window/shown_document.h"

#include <algorithm>

#include "app/platform/platform.h"
#include "app/session/session_files.h"
#include "app/ui/ui.h"
#include "app/window/scene_pane.h"

namespace pedicel::app {

namespace {

// One that was imported, as soon as it is there.
void frame_new_plant(Ui& ui) {
  for (const PlantSnapshot& plant : ui.snapshot->plants) {
    if (ui.frame_plant.empty() || plant.model->name != ui.frame_plant) continue;
    Eigen::AlignedBox3d box;
    for (int e = 0; e < plant.model->size(); ++e)
      box.extend(plant.state.position[static_cast<std::size_t>(e)]);
    box.extend(plant.model->root.position);
    ui.frame_box = box;
    ui.frame_plant.clear();
  }
}

// All is shown where a part of it is out of the picture.
void frame_new_robot(Ui& ui, const SceneFrame& scene) {
  if (!ui.frame_robot || !ui.snapshot->robot.present || !ui.session.is_simulated()) return;
  ui.frame_robot = false;
  const ImVec2 low = scene.low, high(low.x + scene.size.x, low.y + scene.size.y);
  const bool seen = std::ranges::all_of(ui.snapshot->robot.links, [&](const Pose& link) {
    const auto at = scene.project(link.position);
    return at && at->x > low.x && at->x < high.x && at->y > low.y && at->y < high.y;
  });
  if (!seen) ui.ask(Action::frame_all);
}

}  // namespace

void ShownDocument::follow(Ui& ui, Platform& platform, ScenePane& scene) {
  const Snapshot& snapshot = *ui.snapshot;
  std::set<std::string> plants;
  for (const PlantSnapshot& plant : snapshot.plants) plants.insert(plant.model->name);
  // An experiment's plant takes the place of all others, and has no file.
  const bool others =
      !plants.empty() && !plants_.empty() &&
      std::ranges::none_of(plants, [&](const std::string& name) { return plants_.contains(name); });
  if (!plants.empty()) plants_ = std::move(plants);
  if (path_ != ui.session.files().path()) {
    path_ = ui.session.files().path();
    framed_ = false;
    ui.selection = {};
  }
  if (others && ui.session.history().size() == 0) framed_ = false;
  frame_new_plant(ui);
  frame_new_robot(ui, scene.frame());
  std::string title = "Pedicel";
  if (!path_.empty()) title = path_.filename().string() + " - " + title;
  platform.set_title(title);
  if (framed_ || !snapshot.assets || !ui.session.is_simulated()) return;
  framed_ = true;
  if (!snapshot.assets->scene.cameras.empty())
    scene.use_camera(0);
  else
    ui.ask(Action::frame_all);
}

}  // namespace pedicel::app
