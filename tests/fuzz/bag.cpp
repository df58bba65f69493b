#include <sstream>

#include "engine/ros_messages/ros1.h"
#include "engine/ros_messages/sensor_messages.h"
#include "engine/rosbag/reader.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

// A bag is read, or refused with the byte; messages lie within what was read, and are read as what
// an import takes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(fuzz::text_of(data, size));
  mcap::ReaderLimits limits;
  limits.record = 16u << 20;
  std::uint64_t messages = 0, bytes = 0;
  try {
    const mcap::ReadEnd end = rosbag::read(
        file, "f.bag",
        [&](const mcap::Message& message) {
          ++messages;
          for (const char byte : message.data) bytes += static_cast<unsigned char>(byte);
          if (const auto joints = ros::from_ros1<ros::JointState>(message.data))
            fuzz::require(8 * joints->position.size() <= message.data.size(), "no more than came");
          if (const auto frames = ros::from_ros1<ros::TFMessage>(message.data))
            fuzz::require(frames->transforms.size() <= message.data.size(), "no more than came");
        },
        limits);
    fuzz::require(end.messages == messages, "each message is counted");
    fuzz::require(end.at <= size, "the end is in the file");
  } catch (const InvalidFile& fault) {
    fuzz::require(std::string(fault.what()).find("at byte ") != std::string::npos,
                  "the byte of the fault");
  }
  fuzz::require(bytes < (std::uint64_t{1} << 60), "all of it can be read");
  return 0;
}
