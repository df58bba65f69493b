#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "engine/core/check.h"

/// Recorded waypoints, one by one, as commands.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

std::size_t index_of(const Document& document, const Command& c, const char* argument) {
  const int index = c.whole(argument), count = static_cast<int>(document.waypoints.size());
  if (index < 0 || index >= count)
    throw UsageError("waypoint " + std::to_string(index) + ", expected one of " +
                     std::to_string(count) + " from 0 on");
  return static_cast<std::size_t>(index);
}

void check_joints(const Document& document, const std::vector<double>& joints, std::size_t at) {
  const std::size_t wanted = document.waypoints[at].joints.size();
  if (joints.size() != wanted)
    throw UsageError(std::to_string(joints.size()) + " joint values, expected " +
                     std::to_string(wanted));
}

/// Another time puts it where that belongs; one that is taken is refused.
void set_waypoint(Document& document, const Command& c) {
  const std::size_t at = index_of(document, c, "index");
  RobotWaypoint changed = document.waypoints[at];
  if (c.has("joints")) {
    check_joints(document, c.numbers("joints"), at);
    changed.joints = c.numbers("joints");
  }
  changed.time = c.number_or("time", changed.time);
  if (!(changed.time >= 0.0)) throw UsageError("a time before 0, expected s from 0 on");
  document.waypoints.erase(document.waypoints.begin() + static_cast<std::ptrdiff_t>(at));
  const auto place = std::ranges::find_if(
      document.waypoints, [&](const RobotWaypoint& one) { return one.time >= changed.time; });
  if (place != document.waypoints.end() && place->time == changed.time)
    throw UsageError("there is a waypoint at that time already, expected another time");
  document.waypoints.insert(place, std::move(changed));
}

/// The times stay, the poses change their places.
void move_waypoint(Document& document, const Command& c) {
  const std::size_t from = index_of(document, c, "index"), to = index_of(document, c, "to");
  std::vector<std::vector<double>> poses;
  for (RobotWaypoint& one : document.waypoints) poses.push_back(std::move(one.joints));
  std::vector<double> moved = std::move(poses[from]);
  poses.erase(poses.begin() + static_cast<std::ptrdiff_t>(from));
  poses.insert(poses.begin() + static_cast<std::ptrdiff_t>(to), std::move(moved));
  for (std::size_t i = 0; i < poses.size(); ++i) document.waypoints[i].joints = std::move(poses[i]);
}

}  // namespace

std::vector<CommandDescription> waypoint_commands() {
  const Scope d = Scope::document;
  const ArgumentDescription index{"index", Kind::whole, true, "from 0"};
  return {
      {"set waypoint",
       d,
       {index,
        {"time", Kind::number, false, "s after the program's start (as it is)"},
        {"joints", Kind::numbers, false, "rad or m, one a joint (as they are)"}},
       "Gives a waypoint another time or pose.",
       set_waypoint},
      {"move waypoint",
       d,
       {index, {"to", Kind::whole, true, "from 0"}},
       "Puts a waypoint's pose elsewhere in the order; the times stay.",
       move_waypoint},
  };
}

}  // namespace pedicel::app
