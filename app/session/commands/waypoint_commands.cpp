#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/document/document.h"
#include "engine/core/check.h"

/// Recorded waypoints as commands.
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

/// Where one of that time belongs.
auto place_of(Document& document, double time) {
  return std::ranges::find_if(document.waypoints,
                              [&](const RobotWaypoint& one) { return one.time >= time; });
}

void add_waypoint(Document& document, const Command& c) {
  const RobotWaypoint waypoint{c.number("time"), c.numbers("joints")};
  const auto place = place_of(document, waypoint.time);
  if (place != document.waypoints.end() && place->time == waypoint.time)
    *place = waypoint;
  else
    document.waypoints.insert(place, waypoint);
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
  document.waypoints.erase(document.waypoints.begin() + static_cast<std::ptrdiff_t>(at));
  const auto place = place_of(document, changed.time);
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

void set_waypoints(Document& document, const Command& c) {
  const std::vector<double>&times = c.numbers("times"), &joints = c.numbers("joints");
  const std::size_t each = times.empty() ? 0 : joints.size() / times.size();
  if (times.empty() || each == 0 || each * times.size() != joints.size())
    throw UsageError(std::to_string(joints.size()) + " joint values for " +
                     std::to_string(times.size()) + " times, expected as many for each of them");
  std::vector<RobotWaypoint> waypoints;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!(times[i] >= 0.0) || (i > 0 && !(times[i] > times[i - 1])))
      throw UsageError("times, expected s from 0 on that increase");
    const auto row = joints.begin() + static_cast<std::ptrdiff_t>(i * each);
    waypoints.push_back({times[i], {row, row + static_cast<std::ptrdiff_t>(each)}});
  }
  document.waypoints = std::move(waypoints);
}

}  // namespace

std::vector<CommandDescription> waypoint_commands() {
  const ArgumentDescription index{"index", Kind::whole, true, "from 0"};
  return {
      {"add waypoint",
       {{"time", Kind::number, true, "s after the program's start", io::not_negative},
        {"joints", Kind::numbers, true, "rad or m, one a joint"}},
       "Records where the robot is to be.",
       add_waypoint},
      {"delete waypoint",
       {index},
       "Takes a waypoint away.",
       [](Document& document, const Command& c) {
         document.waypoints.erase(document.waypoints.begin() +
                                  static_cast<std::ptrdiff_t>(index_of(document, c, "index")));
       }},
      {"set waypoints",
       {{"times", Kind::numbers, true, "s after the program's start"},
        {"joints", Kind::numbers, true, "rad or m, one a joint, time after time"}},
       "Records other waypoints in place of those there are.",
       set_waypoints},
      {"clear waypoints",
       {},
       "Takes all waypoints away.",
       [](Document& document, const Command&) { document.waypoints.clear(); }},
      {"set waypoint",
       {index,
        {"time", Kind::number, false, "s after the program's start (as it is)", io::not_negative},
        {"joints", Kind::numbers, false, "rad or m, one a joint (as they are)"}},
       "Gives a waypoint another time or pose.",
       set_waypoint},
      {"move waypoint",
       {index, {"to", Kind::whole, true, "from 0"}},
       "Puts a waypoint's pose elsewhere in the order; the times stay.",
       move_waypoint},
  };
}

}  // namespace pedicel::app
