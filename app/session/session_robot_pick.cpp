#include <algorithm>
#include <cmath>

#include "pedicel/app/plants/plant_step.h"
#include "pedicel/app/session/live/pick_program.h"
#include "pedicel/app/session/live/robot_goal.h"
#include "pedicel/app/session/session_core.h"
#include "pedicel/app/session/session_robot.h"
#include "pedicel/core/check.h"

namespace pedicel::app {

Result SessionRobot::pick(const std::string& organ, const std::optional<Vec3>& pull_W) {
  const auto now = snapshot();
  kinematics_of(*now);  // says where there is no robot
  const FruitPlace fruit = find_fruit(*now, organ);
  const robot::Trajectory program =
      pull_W ? pick_program(*now, fruit, *pull_W) : usual_pick(*now, fruit);
  core_.run_edits.add("pull", *snapshot(), core_.editor.history().size(),
                      true);  // undo takes it back
  const Result result = play(program, false);
  picked_ = Picked{organ, now->stage, now->step, now->time + program.times().back()};
  return result;
}

// A plant that gives way to the end of the pull keeps its fruit: that is said.
void SessionRobot::update() {
  constexpr double later = 0.3;  // s, after the pull
  if (!picked_) return;
  const auto now = snapshot();
  if (now->stage != picked_->stage || now->step < picked_->step) return picked_.reset();
  if (now->time < picked_->end + later) return;
  const Picked picked = *std::exchange(picked_, std::nullopt);
  for (const PlantSnapshot& plant : now->plants)
    for (int f = 0; f < static_cast<int>(plant.model->fruits.size()); ++f) {
      const auto index = static_cast<std::size_t>(f);
      const auto element = static_cast<std::size_t>(plant.model->fruits[index].element);
      if (fruit_name(*plant.model, f) != picked.organ || !plant.state.alive[element]) continue;
      const long used = std::lround(100.0 * plant.margin_used[index]);
      core_.messages.say(Severity::warning,
                         "warning: " + picked.organ +
                             " was not taken off: at the end its stalk bears " +
                             std::to_string(used) +
                             " % of what breaks it (a stiffer plant, a weaker stalk or "
                             "\"pick ... pull=X,Y,Z\" another way helps)");
    }
}

}  // namespace pedicel::app
