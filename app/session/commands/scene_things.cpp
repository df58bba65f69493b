#include "app/session/commands/scene_things.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/core/joined.h"

namespace pedicel::app {

namespace {

std::vector<std::string> names_of(const Document& document, ThingKind kind) {
  std::vector<std::string> names;
  const auto take = [&](const auto& items) {
    for (const auto& item : items) names.push_back(item.name);
  };
  if (kind == ThingKind::plant)
    for (const DocumentPlant& one : document.plants) names.push_back(one.entry.name);
  if (kind == ThingKind::body) take(document.scene->bodies);
  if (kind == ThingKind::camera) take(document.scene->cameras);
  return names;
}

}  // namespace

const char* word_of(ThingKind kind) {
  switch (kind) {
    case ThingKind::plant:
      return "plant";
    case ThingKind::body:
      return "body";
    case ThingKind::camera:
      return "camera";
  }
  return "";
}

std::size_t index_of(const Document& document, ThingKind kind, const std::string& name) {
  const std::vector<std::string> names = names_of(document, kind);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string all = joined(names);
  const std::string word = word_of(kind);
  throw UsageError("no " + word + " \"" + name + "\", expected " +
                   (all.empty() ? "one to be added before" : "one of: " + all));
}

void check_new_name(const Document& document, ThingKind kind, const std::string& name) {
  const std::string word = word_of(kind);
  if (std::ranges::count(names_of(document, kind), name) > 0)
    throw UsageError("a " + word + " \"" + name + "\" is there already, expected a new name");
  if (printable(name, name.size()) != name)
    throw UsageError("a " + word + "'s name " + in_quotes(name) +
                     ", expected one without line ends and control characters");
  // A plant file's own name may have a point; a scene refuses it when it is saved.
  const bool plant = kind == ThingKind::plant;
  if (name.empty() || name.find_first_of(plant ? "/" : "/.") != std::string::npos)
    throw UsageError("a " + word + "'s name \"" + name + "\", expected one without /" +
                     (plant ? "" : " and ."));
}

std::string free_name(const Document& document, ThingKind kind, const std::string& like) {
  const std::vector<std::string> names = names_of(document, kind);
  const auto taken = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  if (!taken(like)) return like;
  std::string stem = like;
  const std::size_t cut = like.rfind('_');
  if (cut != std::string::npos && cut + 1 < like.size() &&
      std::all_of(like.begin() + static_cast<long>(cut) + 1, like.end(),
                  [](unsigned char c) { return std::isdigit(c); }))
    stem = like.substr(0, cut);
  for (int i = 2;; ++i)
    if (const std::string name = stem + "_" + std::to_string(i); !taken(name)) return name;
}

// Readers make what they read of length 1, which may change the last bit once more.
Quat read_turn(const std::vector<double>& numbers) {
  Quat turn;
  if (numbers.size() == 3) {
    turn = Eigen::AngleAxisd(numbers[2], Vec3::UnitZ()) *
           Eigen::AngleAxisd(numbers[1], Vec3::UnitY()) *
           Eigen::AngleAxisd(numbers[0], Vec3::UnitX());
  } else if (numbers.size() == 4) {
    turn = Quat(numbers[3], numbers[0], numbers[1], numbers[2]);
  } else {
    throw UsageError("a turn of " + std::to_string(numbers.size()) +
                     " numbers, expected x,y,z,w or roll,pitch,yaw in rad");
  }
  if (!(turn.norm() > 1e-6) || !turn.coeffs().allFinite())
    throw UsageError("a turn of length 0, expected x,y,z,w that are not all 0");
  for (int i = 0; i < 64; ++i) {
    const Quat again = turn.normalized();
    if (again.coeffs() == turn.coeffs()) break;
    const bool swings = again.normalized().coeffs() == turn.coeffs();
    turn = again;
    // Between two neighbours it would for ever: another number gives way by its last bit.
    if (swings) turn.coeffs()[i % 4] = std::nextafter(turn.coeffs()[i % 4], 0.0);
  }
  return turn;
}

std::vector<double> turn_numbers(const Quat& turn) {
  return {turn.x(), turn.y(), turn.z(), turn.w()};
}

Pose read_pose(const Command& command, Pose pose) {
  if (command.has("position")) pose.position = command.point("position");
  if (command.has("turn")) pose.rotation = read_turn(command.numbers("turn"));
  return pose;
}

}  // namespace pedicel::app
