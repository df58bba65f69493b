#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/session/commands/command.h"
#include "app/session/document/document.h"
#include "engine/robot/description.h"

/// What a robot gets by itself when it is added to a scene.
namespace pedicel::app {

/// The files of the robots that come with the program.
std::vector<std::filesystem::path> shipped_robots();

/// The link that is led: one that is named as such (tool, tcp, tool0, ...), else the last one of
/// the longest chain, as far from the base as it goes.
std::string likely_tool(const robot::RobotDescription& robot);
/// The joint of a gripper by its name (finger, grip, jaw); empty: none is named so.
std::string likely_gripper(const robot::RobotDescription& robot);

/// A place that a robot of the scene is for, and the foot of the plant that it is on (m, W).
struct ReachPlace {
  Vec3 place, foot;
};
/// The fruits where they are drawn, the lowest first; without fruits the middles of the stems.
std::vector<ReachPlace> places_to_reach(const Document& document);

/// Where a base stands so that the tool comes to most of the places, from 10 cm before them on and
/// 10 cm back with what it holds, with its Z axis level and towards the plant; as low as can be,
/// and not in the plant. Half a metre from the first place where nothing reaches; the origin
/// without places.
Pose base_near(const robot::RobotDescription& robot, const std::string& tool,
               const std::vector<ReachPlace>& places, double ground);

/// The command `add robot` with all that it leaves out: the whole path, tool, gripper and place.
/// Throws InvalidFile where the robot's file cannot be read. `packages`: "NAME=PATH".
Command placed_robot(const Document& document, const std::vector<std::string>& packages,
                     const Command& add_robot);

}  // namespace pedicel::app
