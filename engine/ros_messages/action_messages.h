#pragma once

#include "engine/ros_messages/control_messages.h"

/// Actions: what a client and a server of one say to each other, and the two that arms have.
namespace pedicel::ros {

struct UUID {
  static constexpr const char* name = "unique_identifier_msgs/msg/UUID";
  std::array<std::uint8_t, 16> uuid{};
  bool operator==(const UUID&) const = default;
  PEDICEL_FIELDS(uuid)
};

struct GoalInfo {
  static constexpr const char* name = "action_msgs/msg/GoalInfo";
  UUID goal_id;
  Time stamp;
  PEDICEL_FIELDS(goal_id, stamp)
};

struct GoalStatus {
  static constexpr const char* name = "action_msgs/msg/GoalStatus";
  static constexpr std::int8_t unknown = 0, accepted = 1, executing = 2, canceling = 3,
                               succeeded = 4, canceled = 5, aborted = 6;
  GoalInfo goal_info;
  std::int8_t status = unknown;
  PEDICEL_FIELDS(goal_info, status)
};

struct GoalStatusArray {
  static constexpr const char* name = "action_msgs/msg/GoalStatusArray";
  std::vector<GoalStatus> status_list;
  PEDICEL_FIELDS(status_list)
};

struct CancelGoal {
  static constexpr const char* service = "action_msgs/srv/CancelGoal";
  static constexpr std::int8_t none = 0, rejected = 1, unknown_goal = 2, terminated = 3;
  struct Request {
    static constexpr const char* name = "action_msgs/srv/CancelGoal_Request";
    GoalInfo goal_info;
    PEDICEL_FIELDS(goal_info)
  };
  struct Response {
    static constexpr const char* name = "action_msgs/srv/CancelGoal_Response";
    std::int8_t return_code = none;
    std::vector<GoalInfo> goals_canceling;
    PEDICEL_FIELDS(return_code, goals_canceling)
  };
};

struct MultiDOFJointTrajectoryPoint {
  static constexpr const char* name = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
  std::vector<Transform> transforms;
  std::vector<TwistMessage> velocities, accelerations;
  Duration time_from_start;
  PEDICEL_FIELDS(transforms, velocities, accelerations, time_from_start)
};

struct MultiDOFJointTrajectory {
  static constexpr const char* name = "trajectory_msgs/msg/MultiDOFJointTrajectory";
  Header header;
  std::vector<std::string> joint_names;
  std::vector<MultiDOFJointTrajectoryPoint> points;
  PEDICEL_FIELDS(header, joint_names, points)
};

struct JointTolerance {
  static constexpr const char* name = "control_msgs/msg/JointTolerance";
  std::string joint;
  double position = 0, velocity = 0, acceleration = 0;
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("name", self.joint);
    visit("position", self.position);
    visit("velocity", self.velocity);
    visit("acceleration", self.acceleration);
  }
};

struct JointComponentTolerance {
  static constexpr const char* name = "control_msgs/msg/JointComponentTolerance";
  std::string joint_name;
  std::uint16_t component = 0;
  double position = 0, velocity = 0, acceleration = 0;
  PEDICEL_FIELDS(joint_name, component, position, velocity, acceleration)
};

struct FollowJointTrajectory {
  static constexpr const char* action = "control_msgs/action/FollowJointTrajectory";
  struct Goal {
    static constexpr const char* name = "control_msgs/action/FollowJointTrajectory_Goal";
    JointTrajectory trajectory;
    MultiDOFJointTrajectory multi_dof_trajectory;
    std::vector<JointTolerance> path_tolerance;
    std::vector<JointComponentTolerance> component_path_tolerance;
    std::vector<JointTolerance> goal_tolerance;
    std::vector<JointComponentTolerance> component_goal_tolerance;
    Duration goal_time_tolerance;
    PEDICEL_FIELDS(trajectory, multi_dof_trajectory, path_tolerance, component_path_tolerance,
                   goal_tolerance, component_goal_tolerance, goal_time_tolerance)
  };
  struct Result {
    static constexpr const char* name = "control_msgs/action/FollowJointTrajectory_Result";
    static constexpr std::int32_t successful = 0, invalid_goal = -1, path_tolerance_violated = -4,
                                  goal_tolerance_violated = -5;
    std::int32_t error_code = successful;
    std::string error_string;
    PEDICEL_FIELDS(error_code, error_string)
  };
  struct Feedback {
    static constexpr const char* name = "control_msgs/action/FollowJointTrajectory_Feedback";
    Header header;
    std::vector<std::string> joint_names;
    JointTrajectoryPoint desired, actual, error;
    std::int32_t index = 0;
    std::vector<std::string> multi_dof_joint_names;
    MultiDOFJointTrajectoryPoint multi_dof_desired, multi_dof_actual, multi_dof_error;
    std::int32_t multi_dof_index = 0;
    PEDICEL_FIELDS(header, joint_names, desired, actual, error, index, multi_dof_joint_names,
                   multi_dof_desired, multi_dof_actual, multi_dof_error, multi_dof_index)
  };
};

struct GripperCommandMessage {
  static constexpr const char* name = "control_msgs/msg/GripperCommand";
  double position = 0, max_effort = 0;
  PEDICEL_FIELDS(position, max_effort)
};

struct GripperCommand {
  static constexpr const char* action = "control_msgs/action/GripperCommand";
  struct Goal {
    static constexpr const char* name = "control_msgs/action/GripperCommand_Goal";
    GripperCommandMessage command;
    PEDICEL_FIELDS(command)
  };
  struct Result {
    static constexpr const char* name = "control_msgs/action/GripperCommand_Result";
    double position = 0, effort = 0;
    bool stalled = false, reached_goal = false;
    PEDICEL_FIELDS(position, effort, stalled, reached_goal)
  };
  struct Feedback {
    static constexpr const char* name = "control_msgs/action/GripperCommand_Feedback";
    double position = 0, effort = 0;
    bool stalled = false, reached_goal = false;
    PEDICEL_FIELDS(position, effort, stalled, reached_goal)
  };
};

/// What rosidl makes of every action.
template <class Action>
struct SendGoalRequest {
  static constexpr const char* name = Action::action;
  UUID goal_id;
  typename Action::Goal goal;
  PEDICEL_FIELDS(goal_id, goal)
};

struct SendGoalResponse {
  static constexpr const char* name = "action/SendGoal_Response";
  bool accepted = false;
  Time stamp;
  PEDICEL_FIELDS(accepted, stamp)
};

struct GetResultRequest {
  static constexpr const char* name = "action/GetResult_Request";
  UUID goal_id;
  PEDICEL_FIELDS(goal_id)
};

template <class Action>
struct GetResultResponse {
  static constexpr const char* name = Action::action;
  std::int8_t status = GoalStatus::unknown;
  typename Action::Result result;
  PEDICEL_FIELDS(status, result)
};

template <class Action>
struct FeedbackMessage {
  static constexpr const char* name = Action::action;
  UUID goal_id;
  typename Action::Feedback feedback;
  PEDICEL_FIELDS(goal_id, feedback)
};

}  // namespace pedicel::ros
