#include "plugins/discrepancy/data/experiment.h"

#include <algorithm>

#include "engine/robot/kinematics.h"

namespace pedicel::discrepancy {

double Trial::duration() const {
  double last = 0.0;
  const auto look = [&](const Samples& samples) {
    if (samples.size() > 0) last = std::max(last, samples.time.back());
  };
  for (const Samples* samples : {&markers, &force, &wrench, &joints, &commands, &torques})
    look(*samples);
  for (const Samples& samples : pixels) look(samples);
  for (const Samples& samples : wrenches) look(samples);
  return last;
}

int Experiment::plant_index(const std::string& name) const {
  for (std::size_t i = 0; i < plants.size(); ++i)
    if (plants[i].name == name) return static_cast<int>(i);
  return -1;
}

bool records_detachments(const Experiment& experiment) {
  return std::ranges::any_of(experiment.trials, [](const Trial& trial) {
    return std::ranges::any_of(trial.events, &MeasuredEvent::is_detachment);
  });
}

std::vector<std::string> joint_names(const robot::RobotDescription& robot) {
  return robot::KinematicModel(robot).joint_names();
}

}  // namespace pedicel::discrepancy
