#pragma once

#include <string>
#include <vector>

#include "pedicel/app/session/commands/command.h"

namespace pedicel::app {

struct Document;

/// What a command acts on, and so what undo takes back: the document only.
enum class Scope {
  document,  ///< plants, settings, waypoints: undone, journalled
  run,       ///< the simulation: play, pull, move the robot
  session,   ///< files and history: open, save, undo
};

/// number, point, numbers and points are values; the others name what is changed (but for `text`).
enum class ArgumentKind { number, whole, word, text, point, numbers, points };

struct ArgumentDescription {
  std::string name;
  ArgumentKind kind = ArgumentKind::word;
  bool needed = true;
  std::string sentence;  ///< what it is, with its unit
};

struct CommandDescription {
  std::string verb;  ///< "move point"
  Scope scope = Scope::document;
  std::vector<ArgumentDescription> arguments;
  std::string sentence;
  /// Document commands: does it, or throws UsageError and leaves the document as it was.
  void (*apply)(Document&, const Command&) = nullptr;

  const ArgumentDescription* find(const std::string& argument) const;
  /// "move point PLANT CURVE INDEX TO"
  std::string usage() const;
};

/// Every command there is. Help, parsing and the reference page come from here.
const std::vector<CommandDescription>& command_table();
/// nullptr where there is none.
const CommandDescription* find_command(const std::string& verb);

// The parts of the table, one a file.
std::vector<CommandDescription> stem_commands();
std::vector<CommandDescription> organ_commands();
std::vector<CommandDescription> document_commands();
std::vector<CommandDescription> scene_commands();
std::vector<CommandDescription> thing_commands();
std::vector<CommandDescription> robot_scene_commands();
std::vector<CommandDescription> waypoint_commands();
std::vector<CommandDescription> run_commands();
std::vector<CommandDescription> measured_commands();

/// Applies a document command: all of it or, with a UsageError, nothing.
void apply_command(Document& document, const Command& command);

}  // namespace pedicel::app
