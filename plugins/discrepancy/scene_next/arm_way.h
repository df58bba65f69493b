#pragma once

#include <Eigen/Dense>
#include <vector>

#include "plugins/discrepancy/scene/arm.h"
#include "plugins/discrepancy/scene_predict/scene_simulator.h"

namespace pedicel::discrepancy {

/// Positions of all joints of an arm over time: even steps from 0 on, straight in between.
struct ArmWay {
  double step = 0.01;              ///< s
  std::vector<Eigen::VectorXd> q;  ///< rad or m, in the order of the robot's model; at least one

  double end() const { return step * static_cast<double>(q.size() - 1); }  ///< s
  Eigen::VectorXd at(double t) const;
  const Eigen::VectorXd& back() const { return q.back(); }
  /// rad/s or m/s, the largest of each joint.
  Eigen::VectorXd fastest() const;
};

/// The way of a trial that was measured: its encoders, smoothed, or its commands as they were told.
ArmWay measured_way(const Experiment& experiment, const Trial& trial);

/// Whether an arm may go a way: as the URDF's limits, the ground and the scene's bodies let it, and
/// always where `measured` went.
class WayCheck {
 public:
  /// `trial` says where the plants stand. Keeps references to neither.
  WayCheck(const Experiment& experiment, const Trial& trial, const ArmWay& measured);

  bool allows(const ArmWay& way) const;
  /// m, from the links to the plants as drawn; negative where they overlap.
  double clearance(const Eigen::VectorXd& q) const;
  /// The point of a plant (m, W) that the arm is nearest to, by that.
  Vec3 nearest_plant(const Eigen::VectorXd& q) const;
  const Arm& arm() const { return arm_; }

 private:
  struct Point {
    Vec3 position = Vec3::Zero();  // m, W
    double radius = 0.0;           // m
  };
  struct Box {
    Pose X_WB;
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // m, B
  };
  // m, W, of the boxes around each link's shapes; infinite for a link without any.
  Eigen::VectorXd lowest(const Eigen::VectorXd& q) const;
  bool is_in(const Box& body, const Eigen::VectorXd& q) const;
  std::pair<double, std::size_t> nearest(const Eigen::VectorXd& q) const;
  void add_plants(const Experiment& experiment, const Trial& trial);

  Arm arm_;
  simulation::ShapeFields fields_;
  std::vector<Point> plants_;
  std::vector<Box> bodies_;  // those that the measured way stays out of
  Eigen::VectorXd lower_, upper_, speed_;
  Eigen::VectorXd floor_;         // m, W, of each link
  double start_clearance_ = 0.0;  // m
};

}  // namespace pedicel::discrepancy
