#include "app/session/robot_placing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "app/session/commands/scene_things.h"
#include "engine/core/check.h"
#include "engine/io/asset_folder.h"
#include "engine/robot/inverse_kinematics.h"
#include "engine/robot/read/read_robot.h"
#include "plugins/plant/plant_edit.h"

namespace pedicel::app {

namespace {

constexpr double way_in = 0.1;  // m, that the tool comes along before it is at a place

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool has_part(const std::string& name, std::initializer_list<const char*> parts) {
  return std::ranges::any_of(
      parts, [&](const char* part) { return lower(name).find(part) != std::string::npos; });
}

bool has_fingers(const robot::RobotDescription& robot, const std::string& link) {
  return has_part(link, {"finger", "jaw", "knuckle"}) || robot.link(link) < 0;
}

/// Level, from the axis above the root to the place: where a plant is thinnest.
Vec3 outward(const Vec3& place, const Vec3& root) {
  Vec3 way = place - root;
  way.z() = 0.0;
  return way.norm() > 0.01 ? Vec3(way.normalized()) : Vec3(Vec3::UnitX());
}

/// How many of the places the tool comes to.
int reached(robot::KinematicModel& model, int tool, const Pose& base,
            const std::vector<ReachPlace>& places, const Vec3& towards) {
  model.set_base_pose(base);
  robot::IkSettings settings;
  settings.restarts = 4;
  settings.iterations = 80;
  settings.position_tolerance = 1e-3;
  settings.rotation_tolerance = 1e-2;
  int count = 0;
  Eigen::VectorXd q = model.neutral();
  for (const ReachPlace& one : places) {
    bool all = true;
    for (const double back : {0.0, way_in}) {
      robot::IkTarget target;
      target.link = tool;
      target.position_W = one.place - back * towards;
      target.approach_W = towards;
      const robot::IkResult found = inverse_kinematics(model, target, q, settings);
      all = all && found.reached;
      if (found.reached) q = found.q;
      if (!all) break;
    }
    count += all;
    if (count == 0) return 0;  // the first one is what it is for
  }
  return count;
}

/// A path, or the name of a robot that comes with the program.
std::filesystem::path robot_file(const std::string& name) {
  std::error_code none;
  if (!std::filesystem::exists(name, none))
    for (const auto& shipped : shipped_robots())
      if (shipped.stem() == name) return shipped;
  return std::filesystem::absolute(name).lexically_normal();
}

}  // namespace

std::vector<std::filesystem::path> shipped_robots() {
  std::vector<std::filesystem::path> files;
  std::error_code none;
  for (const auto& folder :
       std::filesystem::directory_iterator(io::asset_folder() / "robots", none))
    for (const auto& file : std::filesystem::directory_iterator(folder.path(), none))
      if (robot::is_robot_name(file.path())) files.push_back(file.path());
  std::ranges::sort(files);
  return files;
}

std::string likely_tool(const robot::RobotDescription& robot) {
  for (const char* name : {"tool", "tcp", "tool0", "tool_link", "tool_center_point", "ee_link"})
    for (const robot::Link& link : robot.links)
      if (lower(link.name) == name) return link.name;
  for (const robot::Link& link : robot.links)
    if (has_part(link.name, {"tcp", "tool"}) && !has_fingers(robot, link.name)) return link.name;
  const robot::KinematicModel model(robot);
  std::string last;
  int most = -1;
  for (int l = 0; l < model.links(); ++l) {
    int moved = 0;
    for (int i = 0; i < model.dofs(); ++i) moved += model.moves(i, l);
    if (has_fingers(robot, model.link_name(l)) || moved <= most) continue;
    most = moved, last = model.link_name(l);
  }
  return last;
}

std::string likely_gripper(const robot::RobotDescription& robot) {
  for (const robot::Joint& joint : robot.joints)
    if (joint.moves() && !joint.mimic && has_part(joint.name, {"finger", "grip", "jaw"}))
      return joint.name;
  return {};
}

std::vector<ReachPlace> places_to_reach(const Document& document) {
  std::vector<ReachPlace> fruits, stems;
  for (const DocumentPlant& one : document.plants) {
    if (!one.file) continue;
    const Pose& pose = one.entry.pose;
    const auto at = [&](const std::string& name, double share) {
      const auto curve = plant::stem_curve(*one.file, name);
      return ReachPlace{pose * curve.point(share * curve.length()), pose * one.file->root};
    };
    for (const plant::PlantFruit& fruit : one.file->fruits)
      fruits.push_back(at(fruit.place.curve, fruit.place.at));
    for (const plant::PlantCurve& curve : one.file->curves) stems.push_back(at(curve.name, 0.5));
  }
  std::vector<ReachPlace>& places = fruits.empty() ? stems : fruits;
  std::ranges::stable_sort(places, {}, [](const ReachPlace& p) { return p.place.z(); });
  constexpr std::size_t enough = 4;
  if (places.size() > enough) places.resize(enough);
  return places;
}

Pose base_near(const robot::RobotDescription& robot, const std::string& tool,
               const std::vector<ReachPlace>& places, double ground) {
  robot::KinematicModel model(robot);
  const int link = model.link_index(tool);
  Pose best;
  best.position.z() = ground;
  if (places.empty() || link < 0) return best;
  const Vec3 first = places.front().place, away = outward(first, places.front().foot);
  const double turn = std::atan2(-away.y(), -away.x());
  best.rotation = read_turn({0.0, 0.0, turn});
  best.position = first + 0.5 * away;
  best.position.z() = ground;
  constexpr std::array heights = {0.0, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0, 1.3};  // m
  constexpr std::array distances = {0.4, 0.3, 0.5, 0.6, 0.75, 0.9};               // m
  int most = 0;
  for (const double height : heights)
    for (const double distance : distances) {
      Pose base = best;
      base.position = first + distance * away;
      base.position.z() = ground + height;
      const int count = reached(model, link, base, places, -away);
      if (count > most) most = count, best = base;
      if (most == static_cast<int>(places.size())) return best;
    }
  return best;
}

// What a script says is all that counts there: paths are whole, and nothing is chosen again.
Command placed_robot(const Document& document, const std::vector<std::string>& packages,
                     const Command& c) {
  const auto file = robot_file(c.word("file"));
  std::map<std::string, Value> arguments{{"file", file.string()},
                                         {"name", c.word_or("name", "robot")}};
  if (document.scene->robot) return Command(c.verb(), std::move(arguments));  // it is refused
  robot::PackagePaths paths = robot::PackagePaths::from_environment();
  for (const std::string& package : packages) paths.add(package);
  Diagnostics diagnostics;
  const auto robot = robot::read_robot(file, paths, diagnostics);
  if (!robot) throw InvalidFile(diagnostics);
  const std::string tool = c.word_or("tool", likely_tool(*robot));
  const std::string gripper = c.word_or("gripper", likely_gripper(*robot));
  if (!tool.empty()) arguments.emplace("tool", tool);
  if (!gripper.empty()) arguments.emplace("gripper", gripper);
  Pose base;
  if (!c.has("position")) {
    const auto& ground = document.scene->ground;
    base = base_near(*robot, tool, places_to_reach(document), ground ? ground->height : 0.0);
  }
  base = read_pose(c, base);
  // To 0.1 mm: numbers that people can read.
  if (!c.has("position")) base.position = (base.position * 1e4).array().round().matrix() / 1e4;
  arguments.emplace("position", base.position);
  arguments.emplace("turn", turn_numbers(base.rotation));
  return Command(c.verb(), std::move(arguments));
}

}  // namespace pedicel::app
