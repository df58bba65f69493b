#pragma once

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/log_import/log_contents.h"
#include "plugins/discrepancy/log_import/log_map.h"
#include "plugins/discrepancy/log_import/log_scene.h"

namespace pedicel::discrepancy {

/// A log as one trial's tables; times count from the trial's begin.
struct LogTrial {
  std::string name, use, text;
  bool is_run = false;  ///< of a simulation of Pedicel
  double clock = 0.0;   ///< s
  std::vector<std::string> joint_names, command_names, torque_names;
  Samples joints, commands, torques;  ///< rad or m; N m or N
  Samples markers;                    ///< m, W, three columns a marker of the map
  std::vector<Samples> wrenches;      ///< N and N m, one a wrench of the map
  std::vector<MeasuredEvent> events;
  std::vector<std::string> remarks;  ///< what was left out, a sentence each
};

/// What the map says of the scene must be there: links, plants, curves, fruits. Faults go to the
/// diagnostics.
void check_places(const LogMap& map, const LogScene& scene, Diagnostics& diagnostics);

/// Faults (a topic that is not there, joints that are not the robot's, nothing between `from` and
/// `to`) go to the diagnostics, with their place in the map.
LogTrial trial_of_log(const LogContents& log, const LogMap& map, const LogMap::Trial& trial,
                      const LogScene& scene, Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
