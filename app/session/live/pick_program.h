#pragma once

#include <string>

#include "app/session/live/snapshot.h"
#include "engine/robot/trajectory.h"

/// How a robot takes a fruit off: to it, shut, pull.
namespace pedicel::app {

/// A fruit that is on, as it hangs now.
struct FruitPlace {
  Vec3 middle_W = Vec3::Zero();  ///< m
  double radius = 0.0;           ///< m
};
/// Throws UsageError where there is none of that name, or it has come off.
FruitPlace find_fruit(const Snapshot& now, const std::string& organ);

/// How a gripper's joint stands (rad or m) open, and shut on a ball of a radius (m) at the tool.
struct GripperPlaces {
  double open = 0.0, shut = 0.0;
};
GripperPlaces gripper_places(const Snapshot& now, const robot::KinematicModel& model,
                             double radius);

/// From where the robot is: before the fruit with the gripper open, over it, shut, and away by
/// `pull` (m, W), slowly enough for the joints. Throws UsageError with the reason where it cannot.
robot::Trajectory pick_program(const Snapshot& now, const FruitPlace& fruit, const Vec3& pull_W);

/// The same, pulling up and back a little (a plant gives way to the side, and is stiff along its
/// stem) or, where the arm does not come that far, up and back as much, by 34 cm or less.
robot::Trajectory usual_pick(const Snapshot& now, const FruitPlace& fruit);

}  // namespace pedicel::app
