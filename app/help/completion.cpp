#include "app/help/completion.h"

#include <sstream>

#include "engine/core/joined.h"

namespace pedicel::app {

namespace {

std::vector<std::string> names_of_verbs(const CommandWords& words) {
  std::vector<std::string> names;
  for (const VerbWords& verb : words.verbs) names.push_back(verb.name);
  return names;
}

std::vector<std::string> names_of_options(const VerbWords& verb) {
  std::vector<std::string> names;
  for (const OptionWords& option : verb.options)
    names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// The verb that is given, in the shell variable `verb`.
void find_verb(std::ostream& out, const CommandWords& words, const char* given) {
  out << "  local verb='' word\n  for word in " << given << "; do\n    case $word in "
      << joined(names_of_verbs(words), {}, "|") << ") verb=$word; break ;; esac\n  done\n";
}

/// A text may be the name of a file; a number is none.
bool takes_file(const OptionWords& option) {
  return option.choices.empty() && option.value == "TEXT";
}

void bash_values(std::ostream& out, const VerbWords& verb) {
  for (const OptionWords& option : verb.options) {
    if (option.value.empty()) continue;
    for (const std::string& name : option.names)
      out << "    '" << verb.name << " " << name << "') choices='"
          << joined(option.choices, {}, " ") << "' files=" << (takes_file(option) ? "yes" : "no")
          << " ;;\n";
  }
}

/// For a single-quoted word of zsh in which _arguments finds brackets and colons of its own.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return safe;
}

void zsh_arguments(std::ostream& out, const VerbWords& verb, const char* first) {
  out << "_arguments -s";
  for (const OptionWords& option : verb.options)
    for (const std::string& name : option.names) {
      out << " \\\n        '" << (option.repeats ? "*" : "") << name << "[" << quoted(option.help)
          << "]";
      if (!option.value.empty())
        out << ":" << quoted(option.value) << ":"
            << (takes_file(option)       ? "_files"
                : option.choices.empty() ? " "
                                         : "(" + joined(option.choices, {}, " ") + ")");
      out << "'";
    }
  out << first << " \\\n        '*:file:_files' ;;\n";
}

}  // namespace

std::string bash_completion(const CommandWords& words) {
  std::ostringstream out;
  out << "# Completion of pedicel for bash, made by pedicel --completion bash.\n"
         "_pedicel() {\n  local current=${COMP_WORDS[COMP_CWORD]} "
         "before=${COMP_WORDS[COMP_CWORD-1]}\n";
  find_verb(out, words, "\"${COMP_WORDS[@]:1:COMP_CWORD-1}\"");
  out << "  local choices='' files=yes\n  case \"$verb $before\" in\n";
  bash_values(out, words.program);
  for (const VerbWords& verb : words.verbs) bash_values(out, verb);
  out << "    *)\n      case $verb in\n        '') choices='"
      << joined(names_of_options(words.program), {}, " ") << " "
      << joined(names_of_verbs(words), {}, " ") << "' ;;\n";
  for (const VerbWords& verb : words.verbs)
    out << "        " << verb.name << ") choices='" << joined(names_of_options(verb), {}, " ")
        << "' ;;\n";
  out << "      esac ;;\n  esac\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$choices\" -- \"$current\"\n"
         "    [[ $files == no || $current == -* ]] || compgen -f -- \"$current\")\n"
         "}\n"
         "complete -o filenames -F _pedicel pedicel\n";
  return out.str();
}

std::string zsh_completion(const CommandWords& words) {
  std::ostringstream out;
  out << "#compdef pedicel\n# Completion of pedicel for zsh, made by pedicel --completion zsh.\n"
         "_pedicel_first() {\n  local -a verbs=(\n";
  for (const VerbWords& verb : words.verbs)
    out << "    '" << verb.name << ":" << quoted(verb.help) << "'\n";
  out << "  )\n  _describe -t verbs verb verbs\n  _files\n}\n_pedicel() {\n";
  find_verb(out, words, "${words[2,CURRENT-1]}");
  out << "  case $verb in\n";
  for (const VerbWords& verb : words.verbs) {
    out << "    " << verb.name << ")\n      ";
    zsh_arguments(out, verb, "");
  }
  out << "    *)\n      ";
  zsh_arguments(out, words.program, " \\\n        '1: :_pedicel_first'");
  out << "  esac\n}\n_pedicel \"$@\"\n";
  return out.str();
}

}  // namespace pedicel::app
