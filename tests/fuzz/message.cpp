#include <cmath>

#include "pedicel/ros_messages/cdr.h"
#include "pedicel/ros_messages/control_messages.h"
#include "pedicel/ros_messages/marker_messages.h"
#include "pedicel/ros_messages/simulation_messages.h"
#include "reading.h"

using namespace pedicel;

namespace {

// What is read is written and read again as the same.
template <ros::Message M>
void read(const std::string& bytes) {
  const auto message = ros::from_cdr<M>(bytes);
  if (!message) return;
  const std::string written = ros::to_cdr(*message);
  fuzz::require(written.size() <= 3 * bytes.size() + 16, "not much longer than what came");
  const auto again = ros::from_cdr<M>(written);
  fuzz::require(again && ros::to_cdr(*again) == written, "the same again");
}

}  // namespace

// The first byte says which message the rest is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string bytes = fuzz::text_of(data + 1, size - 1);
  switch (data[0] % 10) {
    case 0:
      read<ros::JointState>(bytes);
      break;
    case 1:
      read<ros::WrenchStamped>(bytes);
      break;
    case 2:
      read<ros::TFMessage>(bytes);
      break;
    case 3:
      read<ros::JointTrajectory>(bytes);
      break;
    case 4:
      read<ros::MarkerArray>(bytes);
      break;
    case 5:
      read<ros::CameraInfo>(bytes);
      break;
    case 6:
      read<ros::PointCloud2>(bytes);
      break;
    case 7:
      read<ros::DynamicJointState>(bytes);
      break;
    case 8:
      read<ros::GetEntities::Request>(bytes);
      break;
    default:
      read<ros::StepSimulation::Request>(bytes);
      break;
  }
  return 0;
}
