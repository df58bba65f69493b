#pragma once

#include <string>
#include <vector>

#include "app/session/document/document.h"

namespace pedicel::app {

struct Ui;

/// The part of the robot's panel that is about programs: recorded waypoints, their file, what is
/// played.
class RobotProgramPart {
 public:
  void draw(Ui& ui);

 private:
  void draw_waypoints(Ui& ui);
  void draw_playing(Ui& ui);
  void draw_file(Ui& ui);
  void record(Ui& ui);
  void waypoint_row(Ui& ui, const std::vector<RobotWaypoint>& points, int i);
  void scene_program(Ui& ui);
  /// Where the robot is to be now, rad or m.
  static std::vector<double> pose(const Ui& ui);

  std::string file_ = "waypoints.csv";
  bool loop_ = false;
};

}  // namespace pedicel::app
