#include <set>

#include "app/session/commands/command_line.h"

namespace pedicel::app {

namespace {

/// The description whose verb the line begins with: the longest one. `used` words are the verb.
const CommandDescription* find_verb(const std::vector<LineWord>& words, std::size_t& used) {
  for (used = std::min<std::size_t>(words.size(), 3); used > 0; --used) {
    std::string verb;
    for (std::size_t i = 0; i < used; ++i) verb += (i ? " " : "") + words[i].text;
    const CommandDescription* found = find_command(verb);
    if (found) return found;
  }
  return nullptr;
}

/// The verbs that begin like a line that is none, else all first words.
std::string expected_verbs(const std::string& first) {
  std::string same, any;
  std::string last;
  for (const CommandDescription& one : command_table()) {
    const std::string head = one.verb.substr(0, one.verb.find(' '));
    if (head == first) same += (same.empty() ? "" : ", ") + one.verb;
    if (any.find(head + ",") == std::string::npos) any += head + ", ";
  }
  if (!same.empty()) return same;
  return any.empty() ? any : any.substr(0, any.size() - 2);
}

/// Takes the words behind a verb as its arguments.
class ArgumentReader {
 public:
  ArgumentReader(const CommandDescription& command, const SourcePosition& where,
                 Diagnostics& diagnostics)
      : command_(command), where_(where), diagnostics_(diagnostics) {}

  void take(const LineWord& word) {
    const ArgumentDescription* argument = target(word);
    if (!argument) return;
    if (!taken_.insert(argument->name).second)
      return error(word.column, argument->name + " is given twice, expected once");
    const std::optional<Value> value = read_value(argument->kind, word.text);
    if (!value)
      return error(word.column, argument->name + " is \"" + word.text + "\", expected " +
                                    kind_text(argument->kind));
    arguments_.emplace(argument->name, *value);
  }

  std::optional<Command> finish(int column) {
    for (const ArgumentDescription& argument : command_.arguments)
      if (argument.needed && !arguments_.count(argument.name) && good_) {
        error(column, argument.name + " is missing, expected: " + command_.usage());
        return std::nullopt;
      }
    if (!good_) return std::nullopt;
    return Command(command_.verb, std::move(arguments_));
  }

 private:
  const ArgumentDescription* target(const LineWord& word) {
    if (!word.name.empty()) {
      const ArgumentDescription* named = command_.find(word.name);
      if (!named)
        error(word.column, "unknown argument \"" + word.name + "\", expected: " + command_.usage());
      return named;
    }
    for (const bool needed : {true, false})
      for (const ArgumentDescription& argument : command_.arguments)
        if (argument.needed == needed && !taken_.count(argument.name)) return &argument;
    error(word.column, "\"" + word.text + "\" is too much, expected: " + command_.usage());
    return nullptr;
  }

  void error(int column, const std::string& what) {
    good_ = false;
    diagnostics_.error({where_.file, where_.line, column}, command_.verb + ": " + what);
  }

  const CommandDescription& command_;
  const SourcePosition& where_;
  Diagnostics& diagnostics_;
  std::map<std::string, Value> arguments_;
  std::set<std::string> taken_;  // rightly or not
  bool good_ = true;
};

}  // namespace

std::optional<Command> parse_command(const std::string& line, const SourcePosition& where,
                                     Diagnostics& diagnostics) {
  const auto words = split_line(line);
  if (!words) {
    diagnostics.error({where.file, where.line, static_cast<int>(line.size()) + 1},
                      "a quote is left open, expected a closing \"");
    return std::nullopt;
  }
  if (words->empty()) {
    diagnostics.error({where.file, where.line, 1}, "no command, expected one");
    return std::nullopt;
  }
  std::size_t used = 0;
  const CommandDescription* command = find_verb(*words, used);
  if (!command) {
    diagnostics.error({where.file, where.line, words->front().column},
                      "unknown command \"" + words->front().text +
                          "\", expected one of: " + expected_verbs(words->front().text));
    return std::nullopt;
  }
  ArgumentReader reader(*command, where, diagnostics);
  for (std::size_t i = used; i < words->size(); ++i) reader.take((*words)[i]);
  return reader.finish(static_cast<int>(line.size()) + 1);
}

}  // namespace pedicel::app
