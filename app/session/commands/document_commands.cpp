#include <algorithm>

#include "app/session/commands/command_table.h"
#include "app/session/commands/scene_things.h"
#include "app/session/document/document.h"
#include "app/session/document/settings_check.h"
#include "engine/core/check.h"
#include "plugins/coupling/coupling_settings.h"
#include "plugins/simulation/plants/plant_overrides.h"
#include "plugins/simulation/plants/rod_options.h"

/// Plants as a whole, settings and waypoints as commands.
namespace pedicel::app {

namespace {

using Kind = ArgumentKind;

const ArgumentDescription plant_name{"plant", Kind::word, true, "name of the plant in the scene"};

void add(Document& document, const std::string& name, plant::PlantFile file, const Command& c) {
  DocumentPlant one;
  one.entry.name = name;
  one.entry.pose = read_pose(c);
  if (c.has("file")) one.entry.file = c.word("file");
  one.file = std::make_shared<const plant::PlantFile>(std::move(file));
  document.plants.push_back(std::move(one));
}

/// A herb's green stem: the order of magnitude of turgid stems (Niklas, Plant Biomechanics, 1992,
/// table 2.1); what a drawing says later replaces it.
void new_plant(Document& document, const Command& c) {
  check_new_name(document, ThingKind::plant, c.word("plant"));
  plant::PlantFile file;
  file.name = c.word("plant");
  file.material = {2.0e8, 0.35, 800.0, 0.02};
  file.connect = 0.01;
  file.distance = 0.02;
  add(document, c.word("plant"), std::move(file), c);
}

void add_plant(Document& document, const Command& c) {
  check_new_name(document, ThingKind::plant, c.word("plant"));
  Diagnostics diagnostics;
  auto file = plant::parse_plant(c.word("text"), c.word("plant"), diagnostics);
  if (!file) throw UsageError(sentences(diagnostics.all()));
  add(document, c.word("plant"), std::move(*file), c);
}

/// For texts that were edited by hand, and journals.
void set_plant(Document& document, const Command& c) {
  const int index = document.plant_index(c.word("plant"));
  if (index < 0) return add_plant(document, c);
  document.plant(c.word("plant"));  // it must be one that can be edited
  Diagnostics diagnostics;
  auto file = plant::parse_plant(c.word("text"), c.word("plant"), diagnostics);
  if (!file) throw UsageError(sentences(diagnostics.all()));
  DocumentPlant& one = document.plants[index];
  one.file = std::make_shared<const plant::PlantFile>(std::move(*file));
  one.entry.pose = read_pose(c, one.entry.pose);
}

void set(Document& document, const Command& c) {
  const std::string &key = c.word("key"), &value = c.word("value");
  const auto held = std::find_if(document.settings.begin(), document.settings.end(),
                                 [&](const auto& one) { return one.first == key; });
  if (held == document.settings.end())
    document.settings.emplace_back(key, value);
  else
    held->second = value;
  check_settings(document);
}

void unset(Document& document, const Command& c) {
  if (std::erase_if(document.settings,
                    [&](const auto& one) { return one.first == c.word("key"); }) == 0)
    throw UsageError("\"" + c.word("key") + "\" is as the files say already");
}

void add_waypoint(Document& document, const Command& c) {
  const RobotWaypoint waypoint{c.number("time"), c.numbers("joints")};
  const auto place =
      std::find_if(document.waypoints.begin(), document.waypoints.end(),
                   [&](const RobotWaypoint& one) { return one.time >= waypoint.time; });
  if (waypoint.time < 0.0) throw UsageError("a time before 0, expected s from 0 on");
  if (place != document.waypoints.end() && place->time == waypoint.time)
    *place = waypoint;
  else
    document.waypoints.insert(place, waypoint);
}

void delete_waypoint(Document& document, const Command& c) {
  const int index = c.whole("index"), count = static_cast<int>(document.waypoints.size());
  if (index < 0 || index >= count)
    throw UsageError("waypoint " + std::to_string(index) + ", expected one of " +
                     std::to_string(count) + " from 0 on");
  document.waypoints.erase(document.waypoints.begin() + index);
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

void clear_waypoints(Document& document, const Command&) {
  document.waypoints.clear();
}

}  // namespace

std::vector<CommandDescription> document_commands() {
  const Scope d = Scope::document;
  const ArgumentDescription position{"position", Kind::point, false,
                                     "m, in the world (the origin)"};
  const ArgumentDescription turn{"turn", Kind::numbers, false,
                                 "x,y,z,w, or roll,pitch,yaw in rad (none)"};
  const ArgumentDescription file{"file", Kind::text, false,
                                 "plant file that it came from and is saved to (none)"};
  return {
      {"new plant",
       d,
       {plant_name, position, turn},
       "Adds a plant without stems, to draw.",
       new_plant},
      {"add plant",
       d,
       {plant_name,
        {"text", Kind::text, true, "of a plant file, lines ended by \\n"},
        position,
        turn,
        file},
       "Adds a plant as a plant file says it.",
       add_plant},
      {"set plant",
       d,
       {plant_name,
        {"text", Kind::text, true, "of a plant file, lines ended by \\n"},
        position,
        turn,
        file},
       "Makes a plant what a plant file says; adds it where it is new.",
       set_plant},
      {"set",
       d,
       {{"key", Kind::word, true, "rods.KEY, coupling.KEY, plants.NAME.KEY, dt, ..."},
        {"value", Kind::text, true, "of the key"}},
       "Sets a described number or word of the scene, as --set does.",
       set},
      {"unset",
       d,
       {{"key", Kind::word, true, "that was set"}},
       "Sets a number back to what the files say.",
       unset},
      {"add waypoint",
       d,
       {{"time", Kind::number, true, "s after the program's start"},
        {"joints", Kind::numbers, true, "rad or m, one a joint"}},
       "Records where the robot is to be.",
       add_waypoint},
      {"delete waypoint",
       d,
       {{"index", Kind::whole, true, "from 0"}},
       "Takes a waypoint away.",
       delete_waypoint},
      {"set waypoints",
       d,
       {{"times", Kind::numbers, true, "s after the program's start"},
        {"joints", Kind::numbers, true, "rad or m, one a joint, time after time"}},
       "Records other waypoints in place of those there are.",
       set_waypoints},
      {"clear waypoints", d, {}, "Takes all waypoints away.", clear_waypoints},
  };
}

}  // namespace pedicel::app
