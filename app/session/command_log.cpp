#include "app/session/command_log.h"

#include <algorithm>
#include <filesystem>
#include <map>

namespace pedicel::app {

namespace {

/// A script may be played from another folder.
Command with_whole_path(const Command& command) {
  if (command.verb() != "play trajectory") return command;
  const auto file = std::filesystem::absolute(command.word("file")).lexically_normal();
  std::map<std::string, Value> arguments{{"file", file.string()}};
  if (command.has("loop")) arguments.emplace("loop", command.number("loop"));
  return Command(command.verb(), std::move(arguments));
}

}  // namespace

void CommandLog::add_run(const Command& command) {
  if (command.verb() == "tool" && !lines_.empty() && lines_.back().starts_with("tool "))
    lines_.back() = command.text();
  else
    lines_.push_back(with_whole_path(command).text());
}

void CommandLog::forget(const std::vector<Command>& commands) {
  std::vector<std::string> kept = lines_;
  for (auto command = commands.rbegin(); command != commands.rend(); ++command) {
    const auto found = std::find(kept.rbegin(), kept.rend(), command->text());
    const auto is_history = [](const std::string& line) {
      return line == "undo" || line == "redo";
    };
    if (found == kept.rend() || std::any_of(kept.rbegin(), found, is_history)) {
      lines_.push_back("undo");
      return;
    }
    kept.erase(std::next(found).base());
  }
  lines_ = std::move(kept);
}

}  // namespace pedicel::app
