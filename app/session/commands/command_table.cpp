#include "app/session/commands/command_table.h"

#include <algorithm>
#include <cctype>

#include "app/session/document/document.h"
#include "app/session/document/document_bounds.h"
#include "engine/core/check.h"
#include "engine/core/diagnostics.h"
#include "engine/core/joined.h"
#include "engine/io/csv.h"
#include "engine/io/key.h"
#include "engine/world/scene_reader.h"

namespace pedicel::app {

namespace {

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::vector<CommandDescription> whole_table() {
  std::vector<CommandDescription> table;
  const auto add = [&](Scope scope, std::vector<CommandDescription> part) {
    for (CommandDescription& one : part) {
      one.scope = one.handler.on_document() ? Scope::document : scope;
      table.push_back(std::move(one));
    }
  };
  for (const auto& part : {stem_commands, organ_commands, document_commands, waypoint_commands,
                           scene_commands, thing_commands, tie_commands, robot_scene_commands})
    add(Scope::document, part());
  for (const auto& part : {run_commands, robot_commands}) add(Scope::run, part());
  for (const auto& part : {file_commands, history_commands, film_commands, setting_commands,
                           query_commands, measured_commands})
    add(Scope::session, part());
  return table;
}

}  // namespace

CommandHandler::CommandHandler(OnDocument function) : on_document_(function) {
  PEDICEL_ASSERT(function);
}

CommandHandler::CommandHandler(OnSession function) : on_session_(function) {
  PEDICEL_ASSERT(function);
}

ArgumentDescription argument_of(const std::string& map, const std::string& key, bool needed) {
  const io::Key& of = world::scene_key(map, key);
  const bool place = of.type == io::KeyType::vector, word = of.type == io::KeyType::word;
  std::string sentence = of.unit.empty() || of.unit == "1" ? "" : of.unit + ", ";
  sentence += of.sentence + (word ? ": " + joined(of.words) : "");
  if (const auto* number = std::get_if<double>(&of.otherwise); number && !needed)
    sentence += " (" + io::format_number(*number) + ")";
  if (const auto* text = std::get_if<std::string>(&of.otherwise); text && !needed)
    sentence += " (" + *text + ")";
  return {key,       place ? ArgumentKind::point : word ? ArgumentKind::word : ArgumentKind::number,
          needed,    sentence,
          of.bounds, of.words};
}

void check_within(const std::string& name, double value, const ArgumentDescription& of) {
  if (!io::within(value, of.bounds))
    throw UsageError(name + " " + io::format_number(value) + ", expected " +
                     io::bounds_text(of.bounds) + " (" + of.sentence + ")");
}

void check_arguments(const CommandDescription& description, const Command& command) {
  for (const ArgumentDescription& one : description.arguments) {
    if (!command.has(one.name)) continue;
    if (one.kind == ArgumentKind::number || one.kind == ArgumentKind::whole)
      check_within(one.name, command.number(one.name), one);
    else if (one.kind == ArgumentKind::point)
      for (const double value : command.point(one.name)) check_within(one.name, value, one);
    else if (!one.words.empty() && !std::ranges::count(one.words, command.word(one.name)))
      throw UsageError(one.name + " " + in_quotes(command.word(one.name)) +
                       ", expected one of: " + joined(one.words));
  }
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
  check_arguments(*description, command);
  Document changed = document;
  description->handler.on_document()(changed, command);
  check_bounds(document, changed);
  document = std::move(changed);
}

}  // namespace pedicel::app
