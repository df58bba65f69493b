#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "engine/robot/description.h"

namespace pedicel::robot {

/// Rows 0-2 the linear velocity of a point, rows 3-5 the angular velocity, both in world axes; one
/// column for each degree of freedom.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Velocity of a link: of the origin of its frame, and of its rotation; world axes.
struct Twist {
  Vec3 linear = Vec3::Zero();   ///< m/s
  Vec3 angular = Vec3::Zero();  ///< rad/s
};

/// Kinematics of a description, without Bullet. The degrees of freedom (q, rad or m) are the joints
/// that move by themselves, in the order of the URDF; fixed joints have none and a mimic joint
/// follows its source. Links are numbered as in the description.
class KinematicModel {
 public:
  /// `X_WB` is the pose of the root link in the world.
  explicit KinematicModel(const RobotDescription& robot, const Pose& X_WB = {});

  int dofs() const { return static_cast<int>(names_.size()); }
  const std::vector<std::string>& joint_names() const { return names_; }
  JointType joint_type(int dof) const { return types_[static_cast<std::size_t>(dof)]; }
  /// Index into q, -1 for a name that is no degree of freedom.
  int joint_index(const std::string& name) const;
  int links() const { return static_cast<int>(link_names_.size()); }
  /// Index of a link, -1 where there is none.
  int link_index(const std::string& name) const;
  const std::string& link_name(int link) const { return link_names_[link]; }

  const Eigen::VectorXd& lower() const { return lower_; }  ///< rad or m, may be infinite
  const Eigen::VectorXd& upper() const { return upper_; }
  const Eigen::VectorXd& velocity_limits() const { return velocity_; }
  const Eigen::VectorXd& effort_limits() const { return effort_; }
  /// q with every joint moved into its limits.
  Eigen::VectorXd clamped(const Eigen::VectorXd& q) const;
  /// All joints at 0, or at the limit nearest to 0.
  Eigen::VectorXd neutral() const { return clamped(Eigen::VectorXd::Zero(dofs())); }

  const Pose& base_pose() const { return X_WB_; }
  void set_base_pose(const Pose& X_WB) { X_WB_ = X_WB; }

  /// One link with the joint that carries it; parents come before children, the root first.
  struct Element {
    int link = 0;
    int parent = -1;  ///< link, -1 for the root
    int joint = -1;   ///< in the description, -1 for the root
    JointType type = JointType::fixed;
    Pose X_PJ;
    Vec3 axis = Vec3::UnitX();  ///< in the joint's frame
    int dof = -1;               ///< joint position = multiplier * q[dof] + offset
    double multiplier = 1.0;
    double offset = 0.0;
  };
  const std::vector<Element>& elements() const { return elements_; }

  /// Poses of all links; `X_WL` is resized to links().
  void link_poses(const Eigen::VectorXd& q, std::vector<Pose>& X_WL) const;
  Pose link_pose(const Eigen::VectorXd& q, int link) const;

  /// Velocities of all links at poses from link_poses(); the base moves with `base`.
  void link_velocities(const std::vector<Pose>& X_WL, const Eigen::VectorXd& qd,
                       std::vector<Twist>& twists, const Twist& base = {}) const;

  /// Jacobian of a point fixed in a link (given in the link's frame), at poses from link_poses().
  void jacobian(const std::vector<Pose>& X_WL, int link, const Vec3& point_L, Jacobian& j) const;
  Jacobian jacobian(const Eigen::VectorXd& q, int link, const Vec3& point_L = Vec3::Zero()) const;

  /// Whether a whole turn of this degree of freedom brings every link back: a turning joint that no
  /// mimic follows.
  bool periodic(int dof) const;

  /// Whether a degree of freedom moves a link.
  bool moves(int dof, int link) const;

 private:
  std::vector<Element> elements_;
  std::vector<int> element_of_;  // link to element
  std::vector<std::string> names_, link_names_;
  std::vector<JointType> types_;  // of the degrees of freedom
  Eigen::VectorXd lower_, upper_, velocity_, effort_;
  Pose X_WB_;
};

}  // namespace pedicel::robot
