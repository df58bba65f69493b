#include <iterator>

#include "engine/ros_messages/action_messages.h"
#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/control_messages.h"
#include "engine/ros_messages/marker_messages.h"
#include "engine/ros_messages/ros1.h"
#include "engine/ros_messages/simulation_messages.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

// What is read is written and read again as the same.
template <ros::Message M>
void read(const std::string& bytes) {
  // As ROS 1 has it, too: a log may be one of both.
  if (const auto old = ros::from_ros1<M>(bytes)) {
    const auto again = ros::from_cdr<M>(ros::to_cdr(*old));
    fuzz::require(again && ros::to_cdr(*again) == ros::to_cdr(*old), "the same in both");
  }
  const auto message = ros::from_cdr<M>(bytes);
  if (!message) return;
  const std::string written = ros::to_cdr(*message);
  fuzz::require(written.size() <= 3 * bytes.size() + 16, "not much longer than what came");
  const auto again = ros::from_cdr<M>(written);
  fuzz::require(again && ros::to_cdr(*again) == written, "the same again");
}

// Each that the node, the import or the window reads.
constexpr void (*readers[])(const std::string&) = {
    read<ros::JointState>,
    read<ros::WrenchStamped>,
    read<ros::TFMessage>,
    read<ros::JointTrajectory>,
    read<ros::MarkerArray>,
    read<ros::CameraInfo>,
    read<ros::Imu>,
    read<ros::PointCloud2>,
    read<ros::DynamicJointState>,
    read<ros::GetEntities::Request>,
    read<ros::StepSimulation::Request>,
    read<ros::PoseStamped>,
    read<ros::PointStamped>,
    read<ros::TransformStamped>,
    read<ros::PoseArray>,
    read<ros::String>,
    read<ros::Image>,
    read<ros::GetSimulatorFeatures::Request>,
    read<ros::ResetSimulation::Request>,
    read<ros::SetSimulationState::Request>,
    read<ros::GetEntityState::Request>,
    read<ros::SpawnEntity::Request>,
    read<ros::DeleteEntity::Request>,
    read<ros::SetEntityState::Request>,
    read<ros::SendGoalRequest<ros::FollowJointTrajectory>>,
    read<ros::SendGoalRequest<ros::GripperCommand>>,
    read<ros::GetResultRequest>,
    read<ros::CancelGoal::Request>,
};

}  // namespace

// The first byte says which message the rest is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  readers[data[0] % std::size(readers)](fuzz::text_of(data + 1, size - 1));
  return 0;
}
