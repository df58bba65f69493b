#include "app/h5/h5_log.h"

#include <functional>
#include <set>

#include "app/h5/h5_file.h"
#include "app/report/version.h"
#include "app/topics/simulation_topics.h"
#include "engine/ros_messages/control_messages.h"
#include "engine/ros_messages/sensor_messages.h"

namespace pedicel::app {

namespace {

/// Topics as groups of a file. Clocks, markers and point clouds are left out: the first are in each
/// group, the others follow from poses and depths.
class H5Sink : public TopicSink {
 public:
  explicit H5Sink(const std::filesystem::path& path) : file_(path) {
    file_.set_attribute("/", "format", "pedicel-log");
    file_.set_attribute("/", "library", "pedicel " + version());
  }

  int add(const Topic& topic) override {
    topics_.push_back({topic.name, taker_of(topic.definitions.front().name)});
    return static_cast<int>(topics_.size()) - 1;
  }
  void write(int topic, double time, std::string_view cdr) override {
    const Known& known = topics_[static_cast<std::size_t>(topic)];
    if (known.take) (this->*known.take)(known.name, time, cdr);
  }
  void close() { file_.close(); }

 private:
  using Take = void (H5Sink::*)(const std::string&, double, std::string_view);
  struct Known {
    std::string name;
    Take take = nullptr;  // null: such a topic is not kept
  };

  static Take taker_of(const std::string& type) {
    if (type == ros::JointState::name) return &H5Sink::take_joints;
    if (type == ros::WrenchStamped::name) return &H5Sink::take_vectors<ros::WrenchStamped>;
    if (type == ros::Imu::name) return &H5Sink::take_vectors<ros::Imu>;
    if (type == ros::TFMessage::name) return &H5Sink::take_frames;
    if (type == ros::Image::name) return &H5Sink::take_image;
    if (type == ros::CameraInfo::name) return &H5Sink::take_camera;
    if (type == ros::String::name) return &H5Sink::take_text;
    if (type == ros::DynamicJointState::name) return &H5Sink::take_values;
    return nullptr;
  }

  void time_row(const std::string& group, const ros::Header& header) {
    file_.append(group + "/time", ros::seconds_of(header.stamp));
  }

  void take_joints(const std::string& topic, double, std::string_view cdr) {
    const auto message = *ros::from_cdr<ros::JointState>(cdr);
    time_row(topic, message.header);
    file_.append(topic + "/position", message.position);
    file_.append(topic + "/velocity", message.velocity);
    file_.append(topic + "/effort", message.effort);
    if (named_.insert(topic).second) file_.set_attribute(topic, "names", message.names);
  }

  /// The vectors of a stamped message, each by its field's name.
  template <class M>
  void take_vectors(const std::string& topic, double, std::string_view cdr) {
    const auto message = *ros::from_cdr<M>(cdr);
    time_row(topic, message.header);
    take_fields(topic, message);
    if (named_.insert(topic).second) file_.set_attribute(topic, "frame", message.header.frame_id);
  }
  template <class M>
  void take_fields(const std::string& topic, const M& message) {
    const auto take = [&]<class Field>(const char* name, const Field& field) {
      if constexpr (std::is_same_v<Field, ros::Vector3>)
        file_.append(topic + "/" + name, std::vector<double>{field.x, field.y, field.z});
      else if constexpr (std::is_same_v<Field, ros::Wrench>)
        take_fields(topic, field);
    };
    M::fields(message, take);
  }

  void take_frames(const std::string& topic, double, std::string_view cdr) {
    const auto message = *ros::from_cdr<ros::TFMessage>(cdr);
    for (const ros::TransformStamped& one : message.transforms) {
      const std::string group = topic + "/" + one.child_frame_id;
      const ros::Vector3& p = one.transform.translation;
      const ros::Quaternion& q = one.transform.rotation;
      time_row(group, one.header);
      file_.append(group + "/position", std::vector<double>{p.x, p.y, p.z});
      file_.append(group + "/orientation", std::vector<double>{q.x, q.y, q.z, q.w});
      if (named_.insert(group).second) file_.set_attribute(group, "parent", one.header.frame_id);
    }
  }

  void take_image(const std::string& topic, double, std::string_view cdr) {
    const auto message = *ros::from_cdr<ros::Image>(cdr);
    const std::vector<hsize_t> size{message.height, message.width};
    time_row(topic, message.header);
    if (message.encoding == "rgb8")
      file_.append(topic + "/data", H5File::Kind::byte, {size[0], size[1], 3}, message.data.data());
    else
      file_.append(topic + "/data",
                   message.encoding == "32FC1" ? H5File::Kind::single : H5File::Kind::word, size,
                   message.data.data());
    if (named_.insert(topic).second) file_.set_attribute(topic, "encoding", message.encoding);
  }

  void take_camera(const std::string& topic, double, std::string_view cdr) {
    const auto message = *ros::from_cdr<ros::CameraInfo>(cdr);
    time_row(topic, message.header);
    file_.append(topic + "/k", H5File::Kind::number, {3, 3}, message.k.data());
  }

  void take_text(const std::string& topic, double time, std::string_view cdr) {
    file_.append(topic + "/time", time);
    file_.append_text(topic + "/text", ros::from_cdr<ros::String>(cdr)->data);
  }

  void take_values(const std::string& topic, double, std::string_view cdr) {
    const auto message = *ros::from_cdr<ros::DynamicJointState>(cdr);
    for (std::size_t i = 0; i < message.joint_names.size(); ++i) {
      const ros::InterfaceValue& values = message.interface_values[i];
      const std::string group = topic + "/" + message.joint_names[i];
      time_row(group, message.header);
      file_.append(group + "/values", values.values);
      if (named_.insert(group).second) file_.set_attribute(group, "names", values.interface_names);
    }
  }

  H5File file_;
  std::vector<Known> topics_;
  std::set<std::string> named_;  // groups that have their attribute
};

class H5Watcher : public RunWatcher {
 public:
  H5Watcher(simulation::Simulation& simulation, PictureTaker* taker,
            const std::filesystem::path& path)
      : sink_(path), topics_(simulation, sink_, rates_of_log(simulation), taker) {}
  void begin() override { topics_.begin(); }
  void after_step() override { topics_.after_step(); }
  void end() override { sink_.close(); }

 private:
  H5Sink sink_;
  SimulationTopics topics_;
};

}  // namespace

MakeWatcher h5_log(const std::filesystem::path& file) {
  return [file](simulation::Simulation& simulation, PictureTaker* taker) {
    return std::make_unique<H5Watcher>(simulation, taker, file);
  };
}

}  // namespace pedicel::app
