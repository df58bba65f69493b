#include "app/session/commands/command_table.h"

#include <algorithm>
#include <cctype>

#include "app/session/document/document.h"
#include "app/session/document/document_bounds.h"
#include "engine/core/check.h"

namespace pedicel::app {

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::vector<CommandDescription> whole_table() {
  std::vector<CommandDescription> table = stem_commands();
  for (const auto& part :
       {organ_commands(), document_commands(), waypoint_commands(), scene_commands(),
        thing_commands(), tie_commands(), robot_scene_commands(), run_commands(), robot_commands(),
        file_commands(), history_commands(), film_commands(), setting_commands(), query_commands(),
        measured_commands()})
    table.insert(table.end(), part.begin(), part.end());
  return table;
}

}  // namespace

CommandHandler::CommandHandler(OnDocument function) : on_document_(function) {
  PEDICEL_ASSERT(function);
}

CommandHandler::CommandHandler(OnSession function) : on_session_(function) {
  PEDICEL_ASSERT(function);
}

const ArgumentDescription* CommandDescription::find(const std::string& argument) const {
  for (const ArgumentDescription& one : arguments)
    if (one.name == argument) return &one;
  return nullptr;
}

std::string CommandDescription::usage() const {
  std::string text = verb;
  for (const ArgumentDescription& argument : arguments)
    text += argument.needed ? ' ' + upper(argument.name)
                            : " [" + argument.name + '=' + upper(argument.name) + ']';
  return text;
}

const std::vector<CommandDescription>& command_table() {
  static const std::vector<CommandDescription> table = whole_table();
  return table;
}

const CommandDescription* find_command(const std::string& verb) {
  const auto& table = command_table();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const CommandDescription& one) { return one.verb == verb; });
  return found == table.end() ? nullptr : &*found;
}

void apply_command(Document& document, const Command& command) {
  const CommandDescription* description = find_command(command.verb());
  if (!description || !description->handler.on_document())
    throw UsageError("\"" + command.verb() + "\" does not change the document");
  Document changed = document;
  description->handler.on_document()(changed, command);
  check_bounds(document, changed);
  document = std::move(changed);
}

}  // namespace pedicel::app
