#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "engine/ros_messages/sensor_messages.h"

namespace pedicel::discrepancy {

/// A value with both of its times, s: the sender's stamp and when it was recorded.
template <class T>
struct Timed {
  double stamp = 0.0, logged = 0.0;
  T value;
};
template <class T>
using TimedList = std::vector<Timed<T>>;

/// A frame's place in its parent's.
struct FramePlace {
  std::string parent;
  Pose X_PC;
};

/// A point's place in a frame.
struct PointPlace {
  std::string frame;
  Vec3 position;
};

struct LogTopic {
  std::string name, type;       ///< "/joint_states", "sensor_msgs/msg/JointState"
  std::uint64_t messages = 0;   ///< all of them
  std::uint64_t malformed = 0;  ///< that are no message of that type
  std::uint64_t late = 0;       ///< places of frames whose times go back, which are left out
  bool is_read = false;         ///< its type is one that an experiment can take
};

/// What a log (MCAP, or a bag of ROS 1) holds that an experiment can take, in the file's order.
struct LogContents {
  std::filesystem::path file;
  bool whole = false;  ///< false: the file was cut off; what was whole is here
  /// The log is one of Pedicel's simulations, whose values have no noise of instruments.
  bool simulated = false;
  std::vector<LogTopic> topics;
  std::map<std::string, TimedList<ros::JointState>> joints;  ///< by topic
  std::map<std::string, TimedList<ros::WrenchStamped>> wrenches;
  std::map<std::string, TimedList<std::string>> texts;  ///< std_msgs/String
  std::map<std::string, TimedList<FramePlace>> frames;  ///< of /tf and others, by child frame
  std::map<std::string, FramePlace> fixed_frames;       ///< of /tf_static
  /// Poses and points, by topic; of a PoseArray "TOPIC[i]".
  std::map<std::string, TimedList<PointPlace>> points;

  const LogTopic* topic(const std::string& name) const;  ///< null where there is none
};

/// Reads a file. Messages that are malformed are counted and left out. Throws InvalidFile where it
/// is neither MCAP nor a bag, or damaged.
LogContents read_log(const std::filesystem::path& file);

/// Where a frame is in another at a time of the given clock, between the neighbouring messages of
/// each frame on the way; NaN where there is no way, or not at that time.
Pose frame_at(const LogContents& log, const std::string& frame, const std::string& in, double time,
              bool logged_clock);

}  // namespace pedicel::discrepancy
