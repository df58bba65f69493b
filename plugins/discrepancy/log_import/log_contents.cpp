#include "plugins/discrepancy/log_import/log_contents.h"

#include <algorithm>
#include <limits>

#include "engine/mcap/reader.h"
#include "engine/ros_messages/cdr.h"
#include "engine/ros_messages/ros1.h"
#include "engine/rosbag/reader.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_poses = 1000;  // of a PoseArray
constexpr int deepest_frame = 100;

Vec3 position_of(const ros::Point& p) {
  return {p.x, p.y, p.z};
}

Pose pose_of(const ros::Transform& t) {
  Quat rotation(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z);
  const double size = rotation.norm();
  if (size > 0.0) rotation.coeffs() /= size;
  return {{t.translation.x, t.translation.y, t.translation.z}, rotation};
}

class LogReader {
 public:
  LogContents read(const std::filesystem::path& file) {
    out_.file = file;
    const auto use = [&](const mcap::Message& message) { take(message); };
    // By what it begins with, else by its name: then the reader says what is wrong with it.
    const bool bag = rosbag::is_bag(file) || (file.extension() == ".bag" && !mcap::is_mcap(file));
    const mcap::ReadEnd end = bag ? rosbag::read(file, use) : mcap::read(file, use);
    out_.whole = end.whole;
    out_.simulated = end.library.starts_with("pedicel ");
    return std::move(out_);
  }

 private:
  LogTopic& topic_of(const mcap::Message& message) {
    const auto found = std::ranges::find(out_.topics, message.channel.topic, &LogTopic::name);
    if (found != out_.topics.end()) return *found;
    out_.topics.push_back({message.channel.topic, message.schema.name, 0, 0, 0, false});
    return out_.topics.back();
  }

  void take(const mcap::Message& message) {
    LogTopic& topic = topic_of(message);
    ++topic.messages;
    const std::string& encoding = message.channel.message_encoding;
    if (encoding != "cdr" && encoding != "ros1") return;
    logged_ = 1.0e-9 * static_cast<double>(message.log_time);
    const std::string& name = message.channel.topic;
    topic.is_read = take_as<ros::JointState>(topic, message,
                                             [&](const ros::JointState& m) {
                                               out_.joints[name].push_back(timed(m.header, m));
                                             }) ||
                    take_as<ros::WrenchStamped>(topic, message,
                                                [&](const ros::WrenchStamped& m) {
                                                  out_.wrenches[name].push_back(timed(m.header, m));
                                                }) ||
                    take_as<ros::TFMessage>(
                        topic, message, [&](const ros::TFMessage& m) { take_frames(topic, m); }) ||
                    take_as<ros::String>(topic, message,
                                         [&](const ros::String& m) {
                                           out_.texts[name].push_back({logged_, logged_, m.data});
                                         }) ||
                    take_points(topic, message);
  }

  template <class M, class Take>
  bool take_as(LogTopic& topic, const mcap::Message& message, const Take& use) {
    if (topic.type != M::name) return false;
    const bool old = message.channel.message_encoding == "ros1";
    if (const auto read = old ? ros::from_ros1<M>(message.data) : ros::from_cdr<M>(message.data))
      use(*read);
    else
      ++topic.malformed;
    return true;
  }

  bool take_points(LogTopic& topic, const mcap::Message& message) {
    const std::string& name = topic.name;
    const auto add = [&](const std::string& point, const ros::Header& header, const ros::Point& p) {
      out_.points[point].push_back(timed(header, PointPlace{header.frame_id, position_of(p)}));
    };
    return take_as<ros::PoseStamped>(
               topic, message,
               [&](const ros::PoseStamped& m) { add(name, m.header, m.pose.position); }) ||
           take_as<ros::PointStamped>(
               topic, message, [&](const ros::PointStamped& m) { add(name, m.header, m.point); }) ||
           take_as<ros::TransformStamped>(topic, message,
                                          [&](const ros::TransformStamped& m) {
                                            const ros::Vector3& p = m.transform.translation;
                                            add(name, m.header, {p.x, p.y, p.z});
                                          }) ||
           take_as<ros::PoseArray>(topic, message, [&](const ros::PoseArray& m) {
             for (std::size_t i = 0; i < std::min(m.poses.size(), most_poses); ++i)
               add(name + "[" + std::to_string(i) + "]", m.header, m.poses[i].position);
           });
  }

  // Neighbours of a time are looked up, so what goes back in time has no place: a run that was
  // reset, a second sender.
  void take_frames(LogTopic& topic, const ros::TFMessage& message) {
    const bool fixed = topic.name.ends_with("tf_static");
    for (const ros::TransformStamped& one : message.transforms) {
      const FramePlace place{one.header.frame_id, pose_of(one.transform)};
      if (fixed) {
        out_.fixed_frames[one.child_frame_id] = place;
        continue;
      }
      TimedList<FramePlace>& series = out_.frames[one.child_frame_id];
      const Timed<FramePlace> now = timed(one.header, place);
      if (!series.empty() && (now.stamp < series.back().stamp || now.logged < series.back().logged))
        ++topic.late;
      else
        series.push_back(now);
    }
  }

  template <class T>
  Timed<T> timed(const ros::Header& header, const T& value) const {
    return {ros::seconds_of(header.stamp), logged_, value};
  }

  LogContents out_;
  double logged_ = 0.0;
};

Pose nowhere() {
  Pose pose;
  pose.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  return pose;
}

Pose between(const TimedList<FramePlace>& series, double time, double Timed<FramePlace>::*clock,
             std::string& parent) {
  constexpr double same = 1.0e-9;  // s
  const auto after =
      std::lower_bound(series.begin(), series.end(), time - same,
                       [&](const Timed<FramePlace>& one, double t) { return one.*clock < t; });
  if (after == series.end()) return nowhere();
  parent = after->value.parent;
  if ((*after).*clock <= time + same) return after->value.X_PC;
  if (after == series.begin()) return nowhere();
  const auto before = after - 1;
  if (before->value.parent != parent) return nowhere();
  const double share = (time - (*before).*clock) / ((*after).*clock - (*before).*clock);
  const Pose &a = before->value.X_PC, &b = after->value.X_PC;
  return {(1.0 - share) * a.position + share * b.position, a.rotation.slerp(share, b.rotation)};
}

}  // namespace

const LogTopic* LogContents::topic(const std::string& name) const {
  const auto found = std::ranges::find(topics, name, &LogTopic::name);
  return found == topics.end() ? nullptr : &*found;
}

LogContents read_log(const std::filesystem::path& file) {
  return LogReader().read(file);
}

Pose frame_at(const LogContents& log, const std::string& frame, const std::string& in, double time,
              bool logged_clock) {
  const auto clock = logged_clock ? &Timed<FramePlace>::logged : &Timed<FramePlace>::stamp;
  Pose pose;
  std::string now = frame;
  // A chain that bites its own tail ends, too.
  for (int depth = 0; now != in; ++depth) {
    if (depth == deepest_frame) return nowhere();
    std::string parent;
    if (const auto moving = log.frames.find(now); moving != log.frames.end()) {
      const Pose step = between(moving->second, time, clock, parent);
      if (step.position.hasNaN()) return nowhere();
      pose = step * pose;
    } else if (const auto fixed = log.fixed_frames.find(now); fixed != log.fixed_frames.end()) {
      parent = fixed->second.parent;
      pose = fixed->second.X_PC * pose;
    } else {
      return nowhere();
    }
    now = parent;
  }
  return pose;
}

}  // namespace pedicel::discrepancy
