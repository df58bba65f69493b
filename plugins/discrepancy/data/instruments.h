#pragma once

#include <array>
#include <optional>
#include <string>

#include "engine/core/frames.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

/// A point whose position was measured: on a curve of a plant, in a fruit's centre, or on a link of
/// the robot.
struct Marker {
  std::string name;
  plant::CurvePlace place;       ///< of a curve; its name is empty where it is a fruit or a link
  int plant = 0;                 ///< index into Experiment::plants; -1: of the robot
  int fruit = -1;                ///< index into the plant's fruits
  int link = -1;                 ///< of the robot's description
  Vec3 offset_L = Vec3::Zero();  ///< m, in the link's frame
};

/// A pinhole with Brown's distortion. C: x right, y down, z forward.
struct Camera {
  std::string name;
  Pose X_WC;
  Eigen::Vector2d focal = {1000, 1000};  ///< px
  Eigen::Vector2d centre = {640, 360};   ///< px
  std::array<int, 2> size{1280, 720};    ///< px
  std::array<double, 5> distortion{};    ///< 1: k1 k2 p1 p2 k3
};

/// What a link and all beyond it exert on what carries it: about the origin of the link's frame, in
/// that frame, weight and inertia included.
struct WrenchSensor {
  std::string name;
  int link = -1;       ///< of the robot's description
  bool tared = false;  ///< less its mean over the first tare_time
};
inline constexpr double tare_time = 0.2;  ///< s

/// Known noise of the instruments; what is absent is estimated from the data.
struct StatedNoise {
  std::optional<double> position_std;  ///< m
  std::optional<double> force_std;     ///< N
  std::optional<double> moment_std{};  ///< N m
  /// m, of the rows of paths themselves: what led the plant went elsewhere than they say.
  std::optional<double> path_std{};
  std::optional<double> pixel_std{};   ///< px
  std::optional<double> joint_std{};   ///< rad (m of a sliding joint)
  std::optional<double> torque_std{};  ///< N m (N)
};

}  // namespace pedicel::discrepancy
