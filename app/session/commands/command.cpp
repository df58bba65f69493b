#include "app/session/commands/command.h"

#include <algorithm>

#include "app/session/commands/command_line.h"
#include "app/session/commands/command_table.h"
#include "engine/core/check.h"

namespace pedicel::app {

namespace {

template <class Held>
const Held& held(const std::map<std::string, Value>& arguments, const std::string& name) {
  const auto found = arguments.find(name);
  if (found == arguments.end()) throw UsageError("no argument \"" + name + "\"");
  return std::get<Held>(found->second.held);
}

void check(const std::string& verb, const std::map<std::string, Value>& arguments) {
  const CommandDescription* description = find_command(verb);
  if (!description) throw UsageError("unknown command \"" + verb + "\"");
  for (const auto& [name, value] : arguments) {
    const ArgumentDescription* argument = description->find(name);
    if (!argument)
      throw UsageError(verb + ": unknown argument \"" + name +
                       "\", expected: " + description->usage());
    if (!fits(argument->kind, value))
      throw UsageError(verb + ": " + name + " is \"" + value_text(value) + "\", expected " +
                       kind_text(argument->kind));
  }
  for (const ArgumentDescription& argument : description->arguments)
    if (argument.needed && !arguments.count(argument.name))
      throw UsageError(verb + ": " + argument.name +
                       " is missing, expected: " + description->usage());
}

bool is_name(ArgumentKind kind) {
  return kind == ArgumentKind::word || kind == ArgumentKind::whole;
}

}  // namespace

Command::Command(std::string verb,
                 std::initializer_list<std::pair<const std::string, Value>> arguments)
    : Command(std::move(verb), std::map<std::string, Value>(arguments)) {}

Command::Command(std::string verb, std::map<std::string, Value> arguments)
    : verb_(std::move(verb)), arguments_(std::move(arguments)) {
  check(verb_, arguments_);
}

double Command::number(const std::string& argument) const {
  return held<double>(arguments_, argument);
}
double Command::number_or(const std::string& argument, double value) const {
  return has(argument) ? number(argument) : value;
}
int Command::whole(const std::string& argument) const {
  return static_cast<int>(number(argument));
}
int Command::whole_or(const std::string& argument, int value) const {
  return has(argument) ? whole(argument) : value;
}
const std::string& Command::word(const std::string& argument) const {
  return held<std::string>(arguments_, argument);
}
std::string Command::word_or(const std::string& argument, const std::string& value) const {
  return has(argument) ? word(argument) : value;
}
int Command::choice(const std::string& argument) const {
  const auto& words = find_command(verb_)->find(argument)->words;
  return has(argument) ? static_cast<int>(std::ranges::find(words, word(argument)) - words.begin())
                       : 0;
}
const Vec3& Command::point(const std::string& argument) const {
  return held<Vec3>(arguments_, argument);
}
const std::vector<double>& Command::numbers(const std::string& argument) const {
  return held<std::vector<double>>(arguments_, argument);
}
const std::vector<Vec3>& Command::points(const std::string& argument) const {
  return held<std::vector<Vec3>>(arguments_, argument);
}

std::string Command::text() const {
  std::string text = verb_;
  const CommandDescription* description = find_command(verb_);
  if (!description) return text;
  for (const ArgumentDescription& argument : description->arguments) {
    const auto found = arguments_.find(argument.name);
    if (found == arguments_.end()) continue;
    text += ' ';
    if (!argument.needed) text += argument.name + '=';
    text += value_text(found->second);
  }
  return text;
}

std::string Command::merge_key() const {
  std::string key = verb_;
  const CommandDescription* description = find_command(verb_);
  if (!description) return key;
  for (const ArgumentDescription& argument : description->arguments) {
    const auto found = arguments_.find(argument.name);
    if (found == arguments_.end()) continue;
    key += ' ' + argument.name;
    if (is_name(argument.kind)) key += '=' + value_text(found->second);
  }
  return key;
}

}  // namespace pedicel::app
