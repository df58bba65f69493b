#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "app/session/commands/command.h"
#include "app/session/result.h"
#include "engine/io/bounds.h"

namespace pedicel::app {

struct Document;
class Session;

/// What a command acts on, and so what undo takes back: the document only.
enum class Scope {
  document,  ///< plants, settings, waypoints: undone, journalled
  run,       ///< the simulation: play, pull, move the robot; in the log where it succeeds
  session,   ///< files and history: open, save, undo
};

/// What does a command. It is made of a function and of nothing else, so that a command that nobody
/// does cannot be described.
class CommandHandler {
 public:
  /// Changes the document, or throws UsageError; then the document is thrown away.
  using OnDocument = void (*)(Document&, const Command&);
  /// Does what is not undone. May throw UsageError, InvalidFile and io::WriteError.
  using OnSession = Result (*)(Session&, const Command&);

  CommandHandler(OnDocument function);
  CommandHandler(OnSession function);
  CommandHandler(std::nullptr_t) = delete;
  /// A lambda that stands beside its description. One that returns nothing always does it.
  template <class Lambda>
  requires std::is_class_v<Lambda> CommandHandler(Lambda) {
    if constexpr (std::is_convertible_v<Lambda, OnDocument>)
      on_document_ = Lambda();
    else if constexpr (std::is_convertible_v<Lambda, OnSession>)
      on_session_ = Lambda();
    else
      on_session_ = [](Session& session, const Command& c) -> Result {
        Lambda()(session, c);
        return {};
      };
  }

  /// nullptr where the command is one of the run or the session.
  OnDocument on_document() const { return on_document_; }
  /// nullptr where the command is one of the document.
  OnSession on_session() const { return on_session_; }

 private:
  OnDocument on_document_ = nullptr;
  OnSession on_session_ = nullptr;
};

/// number, point, numbers and points are values; the others name what is changed (but for `text`).
enum class ArgumentKind { number, whole, word, text, point, numbers, points };

struct ArgumentDescription {
  std::string name;
  ArgumentKind kind = ArgumentKind::word;
  bool needed = true;
  std::string sentence;              ///< what it is, with its unit
  io::Bounds bounds{};               ///< of a number, of each number of a point; others are refused
  std::vector<std::string> words{};  ///< of a word; others are refused; empty: any
};
/// As a scene file describes a number, a place or a word of one of its maps ("body", "mass"): unit,
/// sentence, default, bounds, words.
ArgumentDescription argument_of(const std::string& map, const std::string& key, bool needed);
/// Throws UsageError where a number is beyond the bounds that `of` has.
void check_within(const std::string& name, double value, const ArgumentDescription& of);

struct CommandDescription {
  std::string verb;  ///< "move point"
  std::vector<ArgumentDescription> arguments;
  std::string sentence;
  CommandHandler handler;
  /// Document commands: fills in what was left out and what depends on files, so that a journal or
  /// a script does the same again anywhere; nullptr: nothing is to be filled in.
  Command (*complete)(Session&, const Command&) = nullptr;
  /// As its handler and its part of the table have it.
  Scope scope = Scope::document;

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
std::vector<CommandDescription> tie_commands();
std::vector<CommandDescription> robot_scene_commands();
std::vector<CommandDescription> waypoint_commands();
std::vector<CommandDescription> run_commands();
std::vector<CommandDescription> robot_commands();
std::vector<CommandDescription> file_commands();
std::vector<CommandDescription> history_commands();
std::vector<CommandDescription> film_commands();
std::vector<CommandDescription> setting_commands();
std::vector<CommandDescription> query_commands();
std::vector<CommandDescription> measured_commands();

/// Throws UsageError where an argument of a command is beyond its bounds, or none of its words.
void check_arguments(const CommandDescription& description, const Command& command);

/// Applies a document command: all of it or, with a UsageError, nothing.
void apply_command(Document& document, const Command& command);

}  // namespace pedicel::app
