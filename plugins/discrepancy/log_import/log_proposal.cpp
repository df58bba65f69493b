#include "plugins/discrepancy/log_import/log_proposal.h"

#include <algorithm>
#include <set>

#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

namespace {

using plant::yaml_word;

/// How many of the scene's joints a topic has.
std::size_t known_joints(const TimedList<ros::JointState>& series, const LogScene& scene) {
  if (series.empty()) return 0;
  return static_cast<std::size_t>(
      std::ranges::count_if(series.front().value.names, [&](const std::string& name) {
        return std::ranges::find(scene.joints, name) != scene.joints.end();
      }));
}

bool is_of_commands(const std::string& topic) {
  return topic.find("command") != std::string::npos;
}

/// The topic with most of the scene's joints; of equals the first. Empty: none has one.
std::string best_joints(const LogContents& log, const LogScene& scene, bool commands) {
  std::string best;
  std::size_t most = 0;
  for (const auto& [topic, series] : log.joints) {
    const std::size_t known = known_joints(series, scene);
    if (is_of_commands(topic) != commands || known <= most) continue;
    most = known;
    best = topic;
  }
  return best;
}

/// "wrist" of "/wrist/wrench", "ft_sensor" of "/ft_sensor".
std::string name_of_wrench(const std::string& topic) {
  std::string name = topic;
  if (name.ends_with("/wrench")) name.resize(name.size() - 7);
  name = name.substr(name.rfind('/') + 1);
  return name.empty() ? "wrench" : name;
}

std::string joints_text(const LogContents& log, const LogScene& scene) {
  std::string text;
  const std::string joints = best_joints(log, scene, false);
  if (joints.empty()) {
    text += "joints: {topic: ?}   # no topic has a joint of the robot: ";
    for (const std::string& name : scene.joints) text += name + " ";
    return text + "(names: {log's: urdf's} translates)\n";
  }
  text += "joints: {topic: " + yaml_word(joints) + "}\n";
  if (const std::string commands = best_joints(log, scene, true); !commands.empty())
    text += "commands: {topic: " + yaml_word(commands) + "}\n";
  const ros::JointState& first = log.joints.at(joints).front().value;
  if (first.effort.size() == first.names.size())
    text += "# torques: {topic: " + yaml_word(joints) +
            "}   # its efforts, where they are those of the motors\n";
  return text;
}

/// What a frame is on a plant: "PLANT/FRUIT", or the end of "PLANT/CURVE". Empty: neither.
std::string place_of(const std::string& frame, const LogScene& scene) {
  for (const plant::PlantFile& plant : scene.plants) {
    if (!frame.starts_with(plant.name + "/")) continue;
    const std::string part = frame.substr(plant.name.size() + 1);
    const std::string on = "plant: " + yaml_word(plant.name) + ", ";
    for (const plant::PlantFruit& fruit : plant.fruits)
      if (fruit.name == part) return on + "fruit: " + yaml_word(part);
    if (plant.curve_index(part) >= 0) return on + "curve: " + yaml_word(part) + ", at: 1";
  }
  return "";
}

std::string unique_name(std::string name, std::set<std::string>& taken) {
  std::ranges::replace_if(
      name, [](char c) { return std::string("/\\,. \"[]").find(c) != std::string::npos; }, '_');
  while (name.starts_with("_")) name.erase(0, 1);
  std::string free = name.empty() ? "marker" : name;
  for (int i = 2; taken.contains(free); ++i) free = name + "_" + std::to_string(i);
  taken.insert(free);
  return free;
}

std::string markers_text(const LogContents& log, const LogScene& scene) {
  std::string known, unknown;
  std::set<std::string> taken;
  const auto add = [&](const std::string& key, const std::string& source) {
    const std::string place = place_of(source, scene);
    const std::size_t last = source.rfind('/');
    const std::string name = unique_name(place.empty() ? source : source.substr(last + 1), taken);
    const std::string start =
        "- {name: " + yaml_word(name) + ", " + key + ": " + yaml_word(source) + ", ";
    if (!place.empty())
      known += "  " + start + place + "}\n";
    else
      unknown += "  # " + start + "plant: ?, curve: ?, at: ?}\n";
  };
  for (const auto& entry : log.frames) {
    const std::string& frame = entry.first;
    // A body that moves is no marker by itself, and links are where the joints say.
    const bool is_thing = scene.robot.link(frame) >= 0 ||
                          std::ranges::any_of(scene.scene.bodies, [&](const auto& body) {
                            return frame == body.name || frame == "body/" + body.name;
                          });
    if (!is_thing) add("frame", frame);
  }
  for (const auto& [topic, series] : log.points) add("topic", topic);
  if (known.empty() && unknown.empty()) return "";
  return (known.empty() ? "# markers:\n" : "markers:\n") + known + unknown;
}

std::string wrenches_text(const LogContents& log, const LogScene& scene) {
  std::string text;
  std::set<std::string> taken;
  for (const auto& [topic, series] : log.wrenches) {
    if (series.empty()) continue;
    const std::string& frame = series.front().value.header.frame_id;
    const bool known = scene.robot.link(frame) >= 0;
    text += std::string(known ? "  - " : "  # - ") +
            "{name: " + yaml_word(unique_name(name_of_wrench(topic), taken)) +
            ", topic: " + yaml_word(topic) + ", link: " + (known ? yaml_word(frame) : "?") +
            ", tared: false}" + (known ? "" : "   # in the frame " + printable(frame)) + "\n";
  }
  if (text.empty()) return "";
  return (text.find("  - ") == std::string::npos ? "# wrenches:\n" : "wrenches:\n") + text;
}

/// The first topic of happenings; others stand as comments, since a map has one.
std::string events_text(const LogContents& log) {
  std::string text;
  for (const auto& [topic, texts] : log.texts)
    if (topic.ends_with("events"))
      text += (text.empty() ? "events: {topic: " : "# events: {topic: ") + yaml_word(topic) + "}\n";
  return text;
}

/// A simulation's log is exact, and a misfit needs something to be measured by.
std::string noise_text(const LogContents& log) {
  const std::string noise =
      "noise: {position_std: 0.0003, force_std: 0.03, moment_std: 0.002, joint_std: 0.00002}";
  return log.simulated ? noise + "   # a simulation has none: that of good instruments\n"
                       : "# " + noise + "   # where it is known\n";
}

}  // namespace

std::string proposed_map(const LogContents& log, const LogScene& scene,
                         const std::filesystem::path& scene_path) {
  std::string text =
      "# Proposed from the topics of " + printable(log.file.filename().string()) +
      ". The manual's page Logs explains every key.\nformat: pedicel-log-map\nversion: 1\n";
  text += "title: " + yaml_word("a run of " + scene.scene.name) + "\n";
  text += "scene: " + yaml_word(scene_path.string()) + "\n";
  text += "frame: world   # of the log, that is the scene's world\n";
  text += joints_text(log, scene) + markers_text(log, scene) + wrenches_text(log, scene);
  text += events_text(log) + noise_text(log);
  // Names of a log may hold anything: a line end in one is no line of the map.
  std::string other;
  for (const LogTopic& topic : log.topics)
    if (!topic.is_read) other += "#   " + printable(topic.name + " (" + topic.type + ")") + "\n";
  if (!other.empty()) text += "# Topics that an experiment cannot take:\n" + other;
  return text;
}

}  // namespace pedicel::discrepancy
