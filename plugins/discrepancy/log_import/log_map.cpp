#include "plugins/discrepancy/log_import/log_map.h"

#include <algorithm>

#include "engine/io/csv.h"
#include "engine/io/text_file.h"
#include "engine/io/yaml.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

namespace {

using io::YamlMap;
using io::YamlNode;
using plant::yaml_word;

constexpr std::size_t most_entries = 1000;

/// A name that becomes part of a file's or a column's name.
std::string plain_name(YamlMap& map) {
  const auto node = map.required("name");
  const std::string name = node ? node->text("name") : "";
  if (name.find_first_of("/\\,\n\"") != std::string::npos || name == "." || name == "..")
    node->error("name " + in_quotes(name) + ", expected one without / \\ , and quotes");
  return name;
}

LogMap::Joints read_joints(const YamlNode& node, const char* what) {
  YamlMap map(node, what);
  LogMap::Joints joints;
  joints.topic = map.text("topic");
  joints.where = node.position();
  if (const auto names = map.optional("names")) {
    if (!names->is_map()) names->error("names: expected a map of the log's names to the URDF's");
    for (const auto& pair : names->raw())
      if (names->is_map() && pair.first.IsScalar() && pair.second.IsScalar())
        joints.names[pair.first.Scalar()] = pair.second.Scalar();
  }
  map.finish();
  return joints;
}

std::string vector_text(const Vec3& v) {
  return "[" + io::exact_number(v.x()) + ", " + io::exact_number(v.y()) + ", " +
         io::exact_number(v.z()) + "]";
}

LogMap::Marker read_marker(const YamlNode& node) {
  YamlMap map(node, "a marker");
  LogMap::Marker marker;
  marker.where = node.position();
  marker.name = plain_name(map);
  marker.is_frame = map.has("frame");
  if (marker.is_frame == map.has("topic")) node.error("expected one of frame and topic");
  marker.source = marker.is_frame ? map.text("frame") : map.text("topic", "");
  if (map.has("link")) {
    marker.link = map.text("link");
    marker.text = "link: " + yaml_word(marker.link) +
                  ", offset: " + vector_text(map.vector("offset", Vec3::Zero()));
  } else {
    marker.plant = map.text("plant", "");
    if (!marker.plant.empty()) marker.text = "plant: " + yaml_word(marker.plant) + ", ";
    if (map.has("fruit")) {
      marker.fruit = map.text("fruit");
      marker.text += "fruit: " + yaml_word(marker.fruit);
    } else {
      marker.curve = map.text("curve");
      marker.text += "curve: " + yaml_word(marker.curve);
      marker.text += ", at: " + io::exact_number(map.number("at", {0.0, 1.0}));
    }
  }
  map.finish();
  return marker;
}

LogMap::Wrench read_wrench(const YamlNode& node) {
  YamlMap map(node, "a wrench");
  LogMap::Wrench wrench;
  wrench.where = node.position();
  wrench.name = plain_name(map);
  wrench.topic = map.text("topic");
  wrench.link = map.text("link");
  wrench.tared = map.boolean("tared", false);
  wrench.reversed = map.boolean("reversed", false);
  map.finish();
  return wrench;
}

/// A value as the experiment takes it: its own reader judges it.
std::string passed_on(const YamlNode& node) {
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << node.raw();
  return out.c_str();
}

LogMap::Trial read_trial(const YamlNode& node) {
  YamlMap map(node, "a trial");
  LogMap::Trial trial;
  trial.where = node.position();
  trial.name = plain_name(map);
  trial.log = map.text("log", "");
  if (const auto from = map.optional("from")) trial.from = from->number("from");
  if (const auto to = map.optional("to")) trial.to = to->number("to");
  if (trial.from && trial.to && !(*trial.to > *trial.from))
    node.error("to: expected a time after from");
  if (map.has("use")) trial.use = map.choice("use", {"fit", "check"}, "fit");
  trial.clock = map.number("clock", io::any_number, 0.0);
  for (const char* key : {"plants", "masses", "effects"})
    if (const auto passed = map.optional(key))
      trial.text += "    " + std::string(key) + ": " + passed_on(*passed) + "\n";
  map.finish();
  return trial;
}

template <class Items, class Read>
void read_each(YamlMap& map, const char* key, Items& items, const Read& read) {
  for (const YamlNode& node : map.list(key)) {
    if (items.size() == most_entries)
      return node.error(std::string(key) + ": the list goes on, expected at most " +
                        std::to_string(most_entries));
    items.push_back(read(node));
    const auto first = std::ranges::find(items, items.back().name, &Items::value_type::name);
    if (&*first != &items.back())
      node.error(std::string(key) + ": " + in_quotes(items.back().name) +
                 " appears twice, expected each name once");
  }
}

void read_frame(YamlMap& map, LogMap& out) {
  if (const auto frame = map.optional("frame")) {
    if (frame->is_scalar()) {
      out.frame = frame->text("frame");
      return;
    }
    YamlMap placed(*frame, "a frame");
    out.frame = placed.text("name");
    out.X_WF.position = placed.vector("position", Vec3::Zero());
    out.X_WF.rotation = placed.quaternion("orientation", Quat::Identity());
    placed.finish();
  }
}

LogMap read_map(const YamlNode& node) {
  LogMap out;
  YamlMap map(node, "a map of a log");
  if (!node.is_map() || !io::check_format(map, "pedicel-log-map", 1)) return out;
  out.title = map.text("title", "");
  if (const auto scene = map.required("scene")) {
    out.scene = scene->text("scene");
    out.scene_where = scene->position();
  }
  read_frame(map, out);
  out.logged_clock = map.choice("clock", {"stamp", "log"}, "stamp") == "log";
  out.follows_commands = map.choice("follows", {"joints", "commands"}, "joints") == "commands";
  if (const auto joints = map.required("joints")) out.joints = read_joints(*joints, "joints");
  if (const auto joints = map.optional("commands")) out.commands = read_joints(*joints, "commands");
  if (const auto joints = map.optional("torques")) out.torques = read_joints(*joints, "torques");
  if (out.follows_commands && out.commands.topic.empty())
    node.error("follows: commands, expected commands with their topic");
  read_each(map, "markers", out.markers, read_marker);
  read_each(map, "wrenches", out.wrenches, read_wrench);
  if (const auto events = map.optional("events")) {
    YamlMap own(*events, "events");
    out.events = own.text("topic");
    out.events_where = events->position();
    own.finish();
  }
  if (const auto noise = map.optional("noise")) out.noise = passed_on(*noise);
  read_each(map, "trials", out.trials, read_trial);
  map.finish();
  return out;
}

}  // namespace

std::optional<LogMap> parse_log_map(const std::string& text, const std::filesystem::path& name,
                                    Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  try {
    LogMap map = read_map(io::parse_yaml(text, name.string(), diagnostics));
    map.file = name;
    map.text = text;
    if (diagnostics.error_count() == before) return map;
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  return std::nullopt;
}

std::optional<LogMap> read_log_map(const std::filesystem::path& file, Diagnostics& diagnostics) {
  return parse_log_map(io::read_text_file(file), file, diagnostics);
}

}  // namespace pedicel::discrepancy
