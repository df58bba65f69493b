#pragma once

#include <map>
#include <vector>

#include "plugins/coupling/coupling_settings.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// All numbers of a measured scene that a scene's effects may change, beside those of its plants'
/// own models. Nominal: as the files say.
struct SceneState {
  coupling::CouplingSettings coupling;
  std::map<int, double> friction_of_link;  ///< 1, in place of the coupling's

  struct Plant {
    Vec3 offset = Vec3::Zero();  ///< m, W
    double yaw = 0.0;            ///< rad, about the vertical through the root
    double fruit_mass = 1.0;     ///< 1, factor
    double threshold = 1.0;      ///< 1, factor
  };
  std::vector<Plant> plants;

  Vec3 tool_offset = Vec3::Zero();     ///< m, in the link that carries the tool
  Vec3 tool_rotation = Vec3::Zero();   ///< rad, likewise
  Eigen::VectorXd joint_offset;        ///< rad or m: link = reading + offset
  double robot_delay = 0.0;            ///< s, of joints, commands and torques behind the others
  double joint_stiffness = 0.0;        ///< N m/rad between encoder and link; 0: rigid
  double joint_damping_time = 0.01;    ///< s, damping of that spring over its stiffness
  Eigen::VectorXd coulomb, viscous;    ///< N m, N m s/rad, beside the URDF's
  double payload = 0.0;                ///< kg, at the tool
  Vec3 payload_centre = Vec3::Zero();  ///< m, in the tool's link
  double tracking_lag = 0.0;           ///< s

  struct Gauge {
    double gain = 1.0;
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< N, N m, in the sensor's frame
  };
  std::vector<Gauge> gauges;  ///< one a wrench sensor
  std::vector<Camera> cameras;
};

/// As the experiment's files say. Throws InvalidFile where the scene's coupling is faulty.
SceneState nominal_state(const Experiment& experiment);

}  // namespace pedicel::discrepancy
