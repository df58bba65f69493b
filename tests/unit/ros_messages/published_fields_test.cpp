// Fields, types and order of every message as its package publishes it (ROS 2 Jazzy).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/ros_messages/action_messages.h"
#include "engine/ros_messages/control_messages.h"
#include "engine/ros_messages/marker_messages.h"
#include "engine/ros_messages/simulation_messages.h"
#include "engine/ros_messages/type_hash.h"

namespace pedicel::ros {
namespace {

/// The message's own lines, as its .msg file has them without comments and constants.
template <Message M>
std::string lines() {
  std::string text = std::string(M::name) + ":";
  const std::vector<Definition> all = definitions_of<M>();
  for (const FieldDefinition& field : all.front().fields) text += " " + field_text(field) + ";";
  return text;
}

TEST(PublishedFields, OfCommonInterfaces) {
  EXPECT_EQ(lines<Time>(), "builtin_interfaces/msg/Time: int32 sec; uint32 nanosec;");
  EXPECT_EQ(lines<Duration>(), "builtin_interfaces/msg/Duration: int32 sec; uint32 nanosec;");
  EXPECT_EQ(lines<Header>(),
            "std_msgs/msg/Header: builtin_interfaces/Time stamp; string frame_id;");
  EXPECT_EQ(lines<String>(), "std_msgs/msg/String: string data;");
  EXPECT_EQ(lines<ColorRGBA>(),
            "std_msgs/msg/ColorRGBA: float32 r; float32 g; float32 b; float32 a;");
  EXPECT_EQ(lines<Clock>(), "rosgraph_msgs/msg/Clock: builtin_interfaces/Time clock;");
}

TEST(PublishedFields, OfGeometry) {
  EXPECT_EQ(lines<Point>(), "geometry_msgs/msg/Point: float64 x; float64 y; float64 z;");
  EXPECT_EQ(lines<Vector3>(), "geometry_msgs/msg/Vector3: float64 x; float64 y; float64 z;");
  EXPECT_EQ(lines<Quaternion>(),
            "geometry_msgs/msg/Quaternion: float64 x; float64 y; float64 z; float64 w;");
  EXPECT_EQ(lines<PoseMessage>(),
            "geometry_msgs/msg/Pose: geometry_msgs/Point position; geometry_msgs/Quaternion "
            "orientation;");
  EXPECT_EQ(lines<PoseStamped>(),
            "geometry_msgs/msg/PoseStamped: std_msgs/Header header; geometry_msgs/Pose pose;");
  EXPECT_EQ(lines<PoseArray>(),
            "geometry_msgs/msg/PoseArray: std_msgs/Header header; geometry_msgs/Pose[] poses;");
  EXPECT_EQ(lines<PointStamped>(),
            "geometry_msgs/msg/PointStamped: std_msgs/Header header; geometry_msgs/Point point;");
  EXPECT_EQ(lines<Transform>(),
            "geometry_msgs/msg/Transform: geometry_msgs/Vector3 translation; "
            "geometry_msgs/Quaternion rotation;");
  EXPECT_EQ(lines<TransformStamped>(),
            "geometry_msgs/msg/TransformStamped: std_msgs/Header header; string child_frame_id; "
            "geometry_msgs/Transform transform;");
  EXPECT_EQ(lines<TFMessage>(),
            "tf2_msgs/msg/TFMessage: geometry_msgs/TransformStamped[] transforms;");
  EXPECT_EQ(lines<Wrench>(),
            "geometry_msgs/msg/Wrench: geometry_msgs/Vector3 force; geometry_msgs/Vector3 "
            "torque;");
  EXPECT_EQ(lines<WrenchStamped>(),
            "geometry_msgs/msg/WrenchStamped: std_msgs/Header header; geometry_msgs/Wrench "
            "wrench;");
  EXPECT_EQ(lines<TwistMessage>(),
            "geometry_msgs/msg/Twist: geometry_msgs/Vector3 linear; geometry_msgs/Vector3 "
            "angular;");
  EXPECT_EQ(lines<Accel>(),
            "geometry_msgs/msg/Accel: geometry_msgs/Vector3 linear; geometry_msgs/Vector3 "
            "angular;");
}

TEST(PublishedFields, OfSensors) {
  EXPECT_EQ(lines<JointState>(),
            "sensor_msgs/msg/JointState: std_msgs/Header header; string[] name; float64[] "
            "position; float64[] velocity; float64[] effort;");
  EXPECT_EQ(lines<Image>(),
            "sensor_msgs/msg/Image: std_msgs/Header header; uint32 height; uint32 width; string "
            "encoding; uint8 is_bigendian; uint32 step; uint8[] data;");
  EXPECT_EQ(lines<CompressedImage>(),
            "sensor_msgs/msg/CompressedImage: std_msgs/Header header; string format; uint8[] "
            "data;");
  EXPECT_EQ(lines<RegionOfInterest>(),
            "sensor_msgs/msg/RegionOfInterest: uint32 x_offset; uint32 y_offset; uint32 height; "
            "uint32 width; bool do_rectify;");
  EXPECT_EQ(lines<Imu>(),
            "sensor_msgs/msg/Imu: std_msgs/Header header; geometry_msgs/Quaternion orientation; "
            "float64[9] orientation_covariance; geometry_msgs/Vector3 angular_velocity; "
            "float64[9] angular_velocity_covariance; geometry_msgs/Vector3 linear_acceleration; "
            "float64[9] linear_acceleration_covariance;");
  EXPECT_EQ(lines<CameraInfo>(),
            "sensor_msgs/msg/CameraInfo: std_msgs/Header header; uint32 height; uint32 width; "
            "string distortion_model; float64[] d; float64[9] k; float64[9] r; float64[12] p; "
            "uint32 binning_x; uint32 binning_y; sensor_msgs/RegionOfInterest roi;");
  EXPECT_EQ(lines<PointField>(),
            "sensor_msgs/msg/PointField: string name; uint32 offset; uint8 datatype; uint32 "
            "count;");
  EXPECT_EQ(lines<PointCloud2>(),
            "sensor_msgs/msg/PointCloud2: std_msgs/Header header; uint32 height; uint32 width; "
            "sensor_msgs/PointField[] fields; bool is_bigendian; uint32 point_step; uint32 "
            "row_step; uint8[] data; bool is_dense;");
}

TEST(PublishedFields, OfMarkers) {
  EXPECT_EQ(lines<UVCoordinate>(), "visualization_msgs/msg/UVCoordinate: float32 u; float32 v;");
  EXPECT_EQ(lines<MeshFile>(), "visualization_msgs/msg/MeshFile: string filename; uint8[] data;");
  EXPECT_EQ(lines<Marker>(),
            "visualization_msgs/msg/Marker: std_msgs/Header header; string ns; int32 id; int32 "
            "type; int32 action; geometry_msgs/Pose pose; geometry_msgs/Vector3 scale; "
            "std_msgs/ColorRGBA color; builtin_interfaces/Duration lifetime; bool frame_locked; "
            "geometry_msgs/Point[] points; std_msgs/ColorRGBA[] colors; string texture_resource; "
            "sensor_msgs/CompressedImage texture; visualization_msgs/UVCoordinate[] "
            "uv_coordinates; string text; string mesh_resource; visualization_msgs/MeshFile "
            "mesh_file; bool mesh_use_embedded_materials;");
  EXPECT_EQ(lines<MarkerArray>(),
            "visualization_msgs/msg/MarkerArray: visualization_msgs/Marker[] markers;");
}

TEST(PublishedFields, OfControl) {
  EXPECT_EQ(lines<JointTrajectoryPoint>(),
            "trajectory_msgs/msg/JointTrajectoryPoint: float64[] positions; float64[] "
            "velocities; float64[] accelerations; float64[] effort; builtin_interfaces/Duration "
            "time_from_start;");
  EXPECT_EQ(lines<JointTrajectory>(),
            "trajectory_msgs/msg/JointTrajectory: std_msgs/Header header; string[] joint_names; "
            "trajectory_msgs/JointTrajectoryPoint[] points;");
  EXPECT_EQ(lines<InterfaceValue>(),
            "control_msgs/msg/InterfaceValue: string[] interface_names; float64[] values;");
  EXPECT_EQ(lines<DynamicJointState>(),
            "control_msgs/msg/DynamicJointState: std_msgs/Header header; string[] joint_names; "
            "control_msgs/InterfaceValue[] interface_values;");
}

TEST(PublishedFields, OfSimulationInterfaces) {
  EXPECT_EQ(lines<SimulationResult>(),
            "simulation_interfaces/msg/Result: uint8 result; string error_message;");
  EXPECT_EQ(lines<SimulationState>(), "simulation_interfaces/msg/SimulationState: uint8 state;");
  EXPECT_EQ(lines<SimulatorFeatures>(),
            "simulation_interfaces/msg/SimulatorFeatures: uint16[] features; string[] "
            "spawn_formats; string custom_info;");
  EXPECT_EQ(lines<EntityCategory>(), "simulation_interfaces/msg/EntityCategory: uint8 category;");
  EXPECT_EQ(lines<TagsFilter>(),
            "simulation_interfaces/msg/TagsFilter: string[] tags; uint8 filter_mode;");
  EXPECT_EQ(lines<Bounds>(),
            "simulation_interfaces/msg/Bounds: uint8 type; geometry_msgs/Vector3[] points;");
  EXPECT_EQ(lines<EntityFilters>(),
            "simulation_interfaces/msg/EntityFilters: string filter; "
            "simulation_interfaces/EntityCategory[] categories; simulation_interfaces/TagsFilter "
            "tags; simulation_interfaces/Bounds bounds;");
  EXPECT_EQ(lines<EntityState>(),
            "simulation_interfaces/msg/EntityState: std_msgs/Header header; geometry_msgs/Pose "
            "pose; geometry_msgs/Twist twist; geometry_msgs/Accel acceleration;");
  EXPECT_EQ(lines<GetSimulatorFeatures::Response>(),
            "simulation_interfaces/srv/GetSimulatorFeatures_Response: "
            "simulation_interfaces/SimulatorFeatures features;");
  EXPECT_EQ(lines<GetSimulatorFeatures::Request>(),
            "simulation_interfaces/srv/GetSimulatorFeatures_Request: uint8 "
            "structure_needs_at_least_one_member;");
  EXPECT_EQ(lines<GetSimulationState::Request>(),
            "simulation_interfaces/srv/GetSimulationState_Request: uint8 "
            "structure_needs_at_least_one_member;");
  EXPECT_EQ(lines<GetEntities::Request>(),
            "simulation_interfaces/srv/GetEntities_Request: simulation_interfaces/EntityFilters "
            "filters;");
  EXPECT_EQ(lines<GetEntitiesStates::Request>(),
            "simulation_interfaces/srv/GetEntitiesStates_Request: "
            "simulation_interfaces/EntityFilters filters;");
  EXPECT_EQ(lines<GetEntityState::Request>(),
            "simulation_interfaces/srv/GetEntityState_Request: string entity;");
  EXPECT_EQ(lines<ResetSimulation::Response>(),
            "simulation_interfaces/srv/ResetSimulation_Response: simulation_interfaces/Result "
            "result;");
  EXPECT_EQ(lines<StepSimulation::Response>(),
            "simulation_interfaces/srv/StepSimulation_Response: simulation_interfaces/Result "
            "result;");
  EXPECT_EQ(lines<SetSimulationState::Response>(),
            "simulation_interfaces/srv/SetSimulationState_Response: simulation_interfaces/Result "
            "result;");
  EXPECT_EQ(lines<ResetSimulation::Request>(),
            "simulation_interfaces/srv/ResetSimulation_Request: uint8 scope;");
  EXPECT_EQ(lines<StepSimulation::Request>(),
            "simulation_interfaces/srv/StepSimulation_Request: uint64 steps;");
  EXPECT_EQ(lines<GetSimulationState::Response>(),
            "simulation_interfaces/srv/GetSimulationState_Response: "
            "simulation_interfaces/SimulationState state; simulation_interfaces/Result result;");
  EXPECT_EQ(lines<SetSimulationState::Request>(),
            "simulation_interfaces/srv/SetSimulationState_Request: "
            "simulation_interfaces/SimulationState state;");
  EXPECT_EQ(lines<GetEntities::Response>(),
            "simulation_interfaces/srv/GetEntities_Response: simulation_interfaces/Result result; "
            "string[] entities;");
  EXPECT_EQ(lines<GetEntityState::Response>(),
            "simulation_interfaces/srv/GetEntityState_Response: simulation_interfaces/Result "
            "result; simulation_interfaces/EntityState state;");
  EXPECT_EQ(lines<GetEntitiesStates::Response>(),
            "simulation_interfaces/srv/GetEntitiesStates_Response: simulation_interfaces/Result "
            "result; string[] entities; simulation_interfaces/EntityState[] states;");
}

TEST(PublishedFields, OfServicesThatChangeTheScene) {
  EXPECT_EQ(lines<Resource>(),
            "simulation_interfaces/msg/Resource: string uri; string resource_string;");
  EXPECT_EQ(lines<SpawnEntity::Request>(),
            "simulation_interfaces/srv/SpawnEntity_Request: string name; bool allow_renaming; "
            "simulation_interfaces/Resource entity_resource; string entity_namespace; "
            "geometry_msgs/PoseStamped initial_pose;");
  EXPECT_EQ(lines<SpawnEntity::Response>(),
            "simulation_interfaces/srv/SpawnEntity_Response: simulation_interfaces/Result result; "
            "string entity_name;");
  EXPECT_EQ(lines<DeleteEntity::Request>(),
            "simulation_interfaces/srv/DeleteEntity_Request: string entity;");
  EXPECT_EQ(lines<DeleteEntity::Response>(),
            "simulation_interfaces/srv/DeleteEntity_Response: simulation_interfaces/Result "
            "result;");
  EXPECT_EQ(lines<SetEntityState::Request>(),
            "simulation_interfaces/srv/SetEntityState_Request: string entity; "
            "simulation_interfaces/EntityState state; bool set_pose; bool set_twist; bool "
            "set_acceleration;");
  EXPECT_EQ(lines<SetEntityState::Response>(),
            "simulation_interfaces/srv/SetEntityState_Response: simulation_interfaces/Result "
            "result;");
}

TEST(PublishedFields, OfActions) {
  EXPECT_EQ(lines<UUID>(), "unique_identifier_msgs/msg/UUID: uint8[16] uuid;");
  EXPECT_EQ(lines<GoalInfo>(),
            "action_msgs/msg/GoalInfo: unique_identifier_msgs/UUID goal_id; "
            "builtin_interfaces/Time stamp;");
  EXPECT_EQ(lines<GoalStatus>(),
            "action_msgs/msg/GoalStatus: action_msgs/GoalInfo goal_info; int8 status;");
  EXPECT_EQ(lines<GoalStatusArray>(),
            "action_msgs/msg/GoalStatusArray: action_msgs/GoalStatus[] status_list;");
  EXPECT_EQ(lines<CancelGoal::Request>(),
            "action_msgs/srv/CancelGoal_Request: action_msgs/GoalInfo goal_info;");
  EXPECT_EQ(lines<CancelGoal::Response>(),
            "action_msgs/srv/CancelGoal_Response: int8 return_code; action_msgs/GoalInfo[] "
            "goals_canceling;");
  EXPECT_EQ(lines<MultiDOFJointTrajectoryPoint>(),
            "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint: geometry_msgs/Transform[] "
            "transforms; geometry_msgs/Twist[] velocities; geometry_msgs/Twist[] accelerations; "
            "builtin_interfaces/Duration time_from_start;");
  EXPECT_EQ(lines<MultiDOFJointTrajectory>(),
            "trajectory_msgs/msg/MultiDOFJointTrajectory: std_msgs/Header header; string[] "
            "joint_names; trajectory_msgs/MultiDOFJointTrajectoryPoint[] points;");
  EXPECT_EQ(lines<JointTolerance>(),
            "control_msgs/msg/JointTolerance: string name; float64 position; float64 velocity; "
            "float64 acceleration;");
  EXPECT_EQ(lines<JointComponentTolerance>(),
            "control_msgs/msg/JointComponentTolerance: string joint_name; uint16 component; "
            "float64 position; float64 velocity; float64 acceleration;");
  EXPECT_EQ(lines<FollowJointTrajectory::Goal>(),
            "control_msgs/action/FollowJointTrajectory_Goal: trajectory_msgs/JointTrajectory "
            "trajectory; trajectory_msgs/MultiDOFJointTrajectory multi_dof_trajectory; "
            "control_msgs/JointTolerance[] path_tolerance; control_msgs/JointComponentTolerance[] "
            "component_path_tolerance; control_msgs/JointTolerance[] goal_tolerance; "
            "control_msgs/JointComponentTolerance[] component_goal_tolerance; "
            "builtin_interfaces/Duration goal_time_tolerance;");
  EXPECT_EQ(lines<FollowJointTrajectory::Result>(),
            "control_msgs/action/FollowJointTrajectory_Result: int32 error_code; string "
            "error_string;");
  EXPECT_EQ(lines<FollowJointTrajectory::Feedback>(),
            "control_msgs/action/FollowJointTrajectory_Feedback: std_msgs/Header header; string[] "
            "joint_names; trajectory_msgs/JointTrajectoryPoint desired; "
            "trajectory_msgs/JointTrajectoryPoint actual; trajectory_msgs/JointTrajectoryPoint "
            "error; int32 index; string[] multi_dof_joint_names; "
            "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_desired; "
            "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_actual; "
            "trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_error; int32 "
            "multi_dof_index;");
  EXPECT_EQ(lines<GripperCommandMessage>(),
            "control_msgs/msg/GripperCommand: float64 position; float64 max_effort;");
  EXPECT_EQ(lines<GripperCommand::Goal>(),
            "control_msgs/action/GripperCommand_Goal: control_msgs/GripperCommand command;");
  EXPECT_EQ(lines<GripperCommand::Feedback>(),
            "control_msgs/action/GripperCommand_Feedback: float64 position; float64 effort; bool "
            "stalled; bool reached_goal;");
  EXPECT_EQ(lines<SendGoalRequest<GripperCommand>>(),
            "control_msgs/action/GripperCommand: unique_identifier_msgs/UUID goal_id; "
            "control_msgs/action/GripperCommand_Goal goal;");
  EXPECT_EQ(lines<SendGoalResponse>(),
            "action/SendGoal_Response: bool accepted; builtin_interfaces/Time stamp;");
  EXPECT_EQ(lines<GetResultRequest>(),
            "action/GetResult_Request: unique_identifier_msgs/UUID goal_id;");
  EXPECT_EQ(lines<GetResultResponse<GripperCommand>>(),
            "control_msgs/action/GripperCommand: int8 status; "
            "control_msgs/action/GripperCommand_Result result;");
  EXPECT_EQ(lines<FeedbackMessage<GripperCommand>>(),
            "control_msgs/action/GripperCommand: unique_identifier_msgs/UUID goal_id; "
            "control_msgs/action/GripperCommand_Feedback feedback;");
  EXPECT_EQ(lines<GripperCommand::Result>(),
            "control_msgs/action/GripperCommand_Result: float64 position; float64 effort; bool "
            "stalled; bool reached_goal;");
}

// Hashes that rosidl gives messages, and the digest of FIPS 180-4's example.
TEST(PublishedFields, HashesAreThoseOfRosidl) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(std::string(1000, 'a')),
            "41edece42d63e8d9bf515a9ba6932e1c20cbc9f5a5d134645adb5db1b9737ea3");
  EXPECT_EQ(type_hash(definitions_of<String>()),
            "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18");
  EXPECT_EQ(type_hash_of<Clock>(),
            "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564");
  EXPECT_EQ(type_hash_of<JointState>(),
            "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e");
  EXPECT_EQ(type_hash_of<Image>(),
            "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47");
  EXPECT_EQ(type_hash_of<CancelGoal::Request>(),
            "RIHS01_3d3c84653c1f96918086887e1dcb236faec88b81a5b14fd4cf4840065bcdf8af");
  EXPECT_EQ(type_hash_of<CancelGoal::Response>(),
            "RIHS01_35e682cf3f510e83c70a82a4aac888496dedee56773bf9d8e5e0aa81f9e1c960");
}

/// What rosidl takes an empty message for.
struct Empty : Nothing {
  static constexpr const char* name = "std_msgs/msg/Empty";
  template <class Self, class Visit>
  static void fields(Self& self, Visit& visit) {
    visit("structure_needs_at_least_one_member", self.structure_needs_at_least_one_member);
  }
};

TEST(PublishedFields, AHashIsOfTheNameToo) {
  EXPECT_EQ(type_hash_of<Empty>(),
            "RIHS01_20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312");
  const std::string name = "control_msgs/action/GripperCommand_GetResult_Request";
  EXPECT_NE(type_hash_of<GetResultRequest>(name), type_hash_of<GetResultRequest>());
  EXPECT_EQ(type_hash_of<GetResultRequest>(GetResultRequest::name),
            type_hash_of<GetResultRequest>());
}

TEST(PublishedFields, ASchemaHoldsAllMessagesOnce) {
  const std::string line(80, '=');
  EXPECT_EQ(schema_text(definitions_of<WrenchStamped>()),
            "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n" + line +
                "\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n" + line +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n" + line +
                "\nMSG: geometry_msgs/Wrench\ngeometry_msgs/Vector3 force\ngeometry_msgs/Vector3 "
                "torque\n" +
                line + "\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n");
}

}  // namespace
}  // namespace pedicel::ros
