#include "plugins/discrepancy/log_import/log_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "plugins/discrepancy/data/experiment_tables.h"

namespace pedicel::discrepancy {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double same_time = 1.0e-9;  // s

class TrialMaker {
 public:
  TrialMaker(const LogContents& log, const LogMap& map, const LogMap::Trial& wanted,
             const LogScene& scene, Diagnostics& diagnostics)
      : log_(log), map_(map), wanted_(wanted), scene_(scene), diagnostics_(diagnostics) {}

  LogTrial make() {
    out_.name = wanted_.name;
    out_.is_run = log_.simulated;
    out_.use = wanted_.use;
    out_.text = wanted_.text;
    out_.clock = wanted_.clock;
    to_ = wanted_.to.value_or(std::numeric_limits<double>::infinity());
    const int before = diagnostics_.error_count();
    // The trial begins at the first row that drives the arm.
    const LogMap::Joints& driver = map_.follows_commands ? map_.commands : map_.joints;
    begin_ = wanted_.from.value_or(-std::numeric_limits<double>::infinity());
    begin_ = first_of(driver);
    if (diagnostics_.error_count() > before) return {};
    const auto position = &ros::JointState::position;
    out_.joints = joints(map_.joints, position, out_.joint_names);
    if (!map_.commands.topic.empty())
      out_.commands = joints(map_.commands, position, out_.command_names);
    if (!map_.torques.topic.empty())
      out_.torques = joints(map_.torques, &ros::JointState::effort, out_.torque_names);
    // Something may be told after the joints' last row only: the arm stands still then.
    if (!map_.events.empty()) read_events();
    add_markers();
    for (const LogMap::Wrench& wrench : map_.wrenches) out_.wrenches.push_back(readings(wrench));
    for (const LogTopic& topic : log_.topics)
      if (topic.malformed > 0)
        out_.remarks.push_back(topic.name + ": " + std::to_string(topic.malformed) + " of " +
                               std::to_string(topic.messages) + " messages are no " + topic.type +
                               "; left out");
    for (const LogTopic& topic : log_.topics)
      if (topic.late > 0)
        out_.remarks.push_back(topic.name + ": " + std::to_string(topic.late) +
                               " places of frames whose times go back; left out");
    return std::move(out_);
  }

 private:
  template <class T>
  double time_of(const Timed<T>& one) const {
    return map_.logged_clock ? one.logged : one.stamp;
  }
  bool is_within(double time) const {
    return time >= begin_ - same_time && time <= to_ + same_time;
  }
  /// s of the trial; what rounding puts before it belongs to its begin.
  double trial_time(double time) const { return std::max(0.0, time - begin_); }

  void no_topic(const SourcePosition& where, const std::string& topic, const char* type) {
    std::string all;
    for (const LogTopic& one : log_.topics)
      if (one.type == type) all += (all.empty() ? "" : ", ") + one.name;
    diagnostics_.error(where, "topic " + in_quotes(topic) + " of " + type + " is not in " +
                                  log_.file.filename().string() +
                                  ", expected one of: " + (all.empty() ? "(there is none)" : all));
  }

  const TimedList<ros::JointState>* series_of(const LogMap::Joints& joints) {
    const auto found = log_.joints.find(joints.topic);
    if (found != log_.joints.end()) return &found->second;
    no_topic(joints.where, joints.topic, ros::JointState::name);
    return nullptr;
  }

  double first_of(const LogMap::Joints& joints) {
    const TimedList<ros::JointState>* series = series_of(joints);
    if (!series) return 0.0;
    for (const Timed<ros::JointState>& one : *series)
      if (is_within(time_of(one))) return time_of(one);
    diagnostics_.error(joints.where.line > 0 ? joints.where : wanted_.where,
                       "no message of " + joints.topic + " between from and to");
    return 0.0;
  }

  /// Of each joint of the robot that a topic has: its place in the messages. URDF names by it.
  std::vector<std::pair<std::size_t, std::string>> columns_of(const LogMap::Joints& joints,
                                                              const ros::JointState& first) {
    std::vector<std::pair<std::size_t, std::string>> columns;
    for (std::size_t i = 0; i < first.names.size(); ++i) {
      const auto renamed = joints.names.find(first.names[i]);
      const std::string& name = renamed == joints.names.end() ? first.names[i] : renamed->second;
      if (std::ranges::find(scene_.joints, name) != scene_.joints.end())
        columns.emplace_back(i, name);
      else if (renamed != joints.names.end())
        diagnostics_.error(joints.where, "names: " + in_quotes(name) +
                                             " is no joint that moves by itself of " +
                                             scene_.robot.file);
    }
    if (columns.empty())
      diagnostics_.error(joints.where, joints.topic + " has no joint of the robot (it has " +
                                           (first.names.empty() ? "none" : first.names.front()) +
                                           ", ...), expected names: {log's: urdf's}");
    return columns;
  }

  Samples joints(const LogMap::Joints& wanted, std::vector<double> ros::JointState::*values,
                 std::vector<std::string>& names) {
    const TimedList<ros::JointState>* series = series_of(wanted);
    Samples samples;
    if (!series || series->empty()) return samples;
    const ros::JointState& first = series->front().value;
    const auto columns = columns_of(wanted, first);
    for (const auto& [at, name] : columns) names.push_back(name);
    std::vector<double> rows;
    std::size_t others = 0;
    for (const Timed<ros::JointState>& one : *series) {
      const double time = time_of(one);
      if (!is_within(time)) continue;
      const std::vector<double>& row = one.value.*values;
      const bool whole = one.value.names == first.names && row.size() == first.names.size();
      if (!whole || !after_last(samples, time)) {
        ++others;
        continue;
      }
      samples.time.push_back(trial_time(time));
      for (const auto& [at, name] : columns) rows.push_back(row[at]);
    }
    if (others > 0)
      out_.remarks.push_back(wanted.topic + ": " + std::to_string(others) +
                             " messages with other joints, without values or not in the order of "
                             "time; left out");
    if (samples.time.empty())
      diagnostics_.error(wanted.where, wanted.topic + " has no such values between from and to");
    samples.value = matrix_of_rows(rows, columns.size());
    return samples;
  }

  bool after_last(const Samples& samples, double time) const {
    return samples.time.empty() || trial_time(time) > samples.time.back();
  }

  Samples readings(const LogMap::Wrench& wanted) {
    Samples samples;
    const auto found = log_.wrenches.find(wanted.topic);
    if (found == log_.wrenches.end()) {
      no_topic(wanted.where, wanted.topic, ros::WrenchStamped::name);
      return samples;
    }
    const double sign = wanted.reversed ? -1.0 : 1.0;
    std::vector<double> rows;
    std::size_t late = 0;
    for (const Timed<ros::WrenchStamped>& one : found->second) {
      const double time = time_of(one);
      if (!is_within(time)) continue;
      if (!after_last(samples, time)) {
        ++late;
        continue;
      }
      samples.time.push_back(trial_time(time));
      const ros::Vector3 &f = one.value.wrench.force, &m = one.value.wrench.torque;
      for (const double value : {f.x, f.y, f.z, m.x, m.y, m.z}) rows.push_back(sign * value);
    }
    if (late > 0)
      out_.remarks.push_back(wanted.topic + ": " + std::to_string(late) +
                             " messages not in the order of time; left out");
    samples.value = matrix_of_rows(rows, 6);
    return samples;
  }

  /// The frame itself, or what carries it where it is fixed.
  std::map<std::string, TimedList<FramePlace>>::const_iterator moving_frame(
      std::string frame) const {
    // No longer than there are fixed frames: a chain may bite its own tail.
    for (std::size_t i = 0; i <= log_.fixed_frames.size(); ++i) {
      if (const auto found = log_.frames.find(frame); found != log_.frames.end()) return found;
      const auto fixed = log_.fixed_frames.find(frame);
      if (fixed == log_.fixed_frames.end()) break;
      frame = fixed->second.parent;
    }
    return log_.frames.end();
  }

  /// Places of a marker in the scene's world, by the log's time.
  std::map<double, Vec3> places_of(const LogMap::Marker& marker) {
    std::map<double, Vec3> places;
    const auto add = [&](double time, const std::string& frame, const Vec3& position) {
      if (!is_within(time)) return;
      const Pose pose = frame_at(log_, frame, map_.frame, time, map_.logged_clock);
      places[trial_time(time)] = map_.X_WF * (pose * position);
    };
    if (marker.is_frame) {
      const auto found = moving_frame(marker.source);
      if (found == log_.frames.end())
        diagnostics_.error(marker.where, "frame " + in_quotes(marker.source) + " is not in " +
                                             log_.file.filename().string() + " as one that moves");
      else
        for (const Timed<FramePlace>& one : found->second)
          add(time_of(one), marker.source, Vec3::Zero());
    } else if (const auto found = log_.points.find(marker.source); found != log_.points.end()) {
      for (const Timed<PointPlace>& one : found->second)
        add(time_of(one), one.value.frame, one.value.position);
    } else {
      no_topic(marker.where, marker.source, ros::PoseStamped::name);
    }
    const bool seen =
        std::ranges::any_of(places, [](const auto& place) { return !place.second.hasNaN(); });
    if (!places.empty() && !seen)
      diagnostics_.error(marker.where, in_quotes(marker.source) + " has no way to the frame " +
                                           in_quotes(map_.frame) +
                                           ", expected frame: to name the "
                                           "log's own");
    return places;
  }

  /// s, when the marker's fruit came off: what falls is not a place on the plant.
  double end_of(const LogMap::Marker& marker) const {
    double end = std::numeric_limits<double>::infinity();
    for (const MeasuredEvent& event : out_.events)
      if (!marker.fruit.empty() && event.event == "detached" && event.what == marker.fruit)
        end = std::min(end, event.time);
    return end;
  }

  void add_markers() {
    std::map<double, std::vector<double>> rows;
    const std::size_t columns = 3 * map_.markers.size();
    for (std::size_t m = 0; m < map_.markers.size(); ++m) {
      const double end = end_of(map_.markers[m]);
      for (const auto& [time, place] : places_of(map_.markers[m])) {
        if (place.hasNaN() || time >= end) continue;
        std::vector<double>& row = rows[time];
        row.resize(columns, missing);
        for (std::size_t i = 0; i < 3; ++i) row[3 * m + i] = place[static_cast<long>(i)];
      }
    }
    std::vector<double> all;
    for (const auto& [time, row] : rows) {
      out_.markers.time.push_back(time);
      all.insert(all.end(), row.begin(), row.end());
    }
    out_.markers.value = matrix_of_rows(all, columns);
  }

  /// "fruit_1" of "truss/fruit_1", where truss is a plant of the scene.
  std::string without_plant(const std::string& organ) const {
    for (const plant::PlantFile& plant : scene_.plants)
      if (organ.starts_with(plant.name + "/")) return organ.substr(plant.name.size() + 1);
    return organ;
  }

  void read_events() {
    const auto found = log_.texts.find(map_.events);
    if (found == log_.texts.end()) {
      // A topic on which nothing happened has no message.
      if (!log_.topic(map_.events))
        out_.remarks.push_back(map_.events + ": nothing happened, so no table of events");
      return;
    }
    constexpr const char* kinds[] = {"grasped", "released", "detached", "slipped"};
    std::size_t others = 0;
    for (const Timed<std::string>& one : found->second) {
      const auto json = nlohmann::json::parse(one.value, nullptr, false);
      MeasuredEvent event;
      if (json.is_object()) {
        const auto text = [&](const char* key) {
          return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
        };
        event = {one.logged, text("event"), without_plant(text("what")), text("by")};
        if (json.contains("time") && json["time"].is_number() && !map_.logged_clock)
          event.time = json["time"].get<double>();
      }
      if (std::ranges::find(kinds, event.event) == std::end(kinds))
        ++others;
      else if (is_within(event.time))
        out_.events.push_back({trial_time(event.time), event.event, event.what, event.by});
    }
    if (others > 0)
      out_.remarks.push_back(map_.events + ": " + std::to_string(others) +
                             " texts are no events of an experiment; left out");
  }

  const LogContents& log_;
  const LogMap& map_;
  const LogMap::Trial& wanted_;
  const LogScene& scene_;
  Diagnostics& diagnostics_;
  LogTrial out_;
  double begin_ = 0.0, to_ = 0.0;  // s of the log's clock
};

}  // namespace

LogTrial trial_of_log(const LogContents& log, const LogMap& map, const LogMap::Trial& trial,
                      const LogScene& scene, Diagnostics& diagnostics) {
  return TrialMaker(log, map, trial, scene, diagnostics).make();
}

}  // namespace pedicel::discrepancy
