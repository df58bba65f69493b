#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/commands/command.h"
#include "app/session/document/document.h"
#include "app/session/document/scene_references.h"

/// What the commands about things of a scene share: looking them up by name, and their arguments.
namespace pedicel::app {

/// Index in its list; throws UsageError that says which there are.
std::size_t index_of(const Document& document, ThingKind kind, const std::string& name);
/// Throws UsageError for a name that is taken or that no file could hold.
void check_new_name(const Document& document, ThingKind kind, const std::string& name);
/// "body_2": a name like another one's that is free.
std::string free_name(const Document& document, ThingKind kind, const std::string& like);
/// "plant", "body", "camera".
const char* word_of(ThingKind kind);

/// x,y,z,w, or roll,pitch,yaw (rad, about the world's X, then Y, then Z, as in URDF). As a file
/// reads it back, to the last bit. Throws UsageError.
Quat read_turn(const std::vector<double>& numbers);
std::vector<double> turn_numbers(const Quat& turn);  ///< x, y, z, w
/// The arguments `position` and `turn` of a command, over `pose`.
Pose read_pose(const Command& command, Pose pose = {});

}  // namespace pedicel::app
