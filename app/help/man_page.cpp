#include "app/help/man_page.h"

#include <sstream>

#include "engine/core/joined.h"

namespace pedicel::app {

namespace {

/// Text of a line: hyphens that can be copied, and nothing that roff takes for a request.
std::string roff(const std::string& text) {
  std::string safe = text.starts_with(".") || text.starts_with("'") ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe;
}

std::string bold(const std::string& text) {
  return "\\fB" + roff(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + roff(text) + "\\fR";
}

std::string value_of(const OptionWords& option) {
  std::string text;
  for (const std::string& choice : option.choices) text += (text.empty() ? "" : "|") + choice;
  return text.empty() ? italic(option.value) : roff(text);
}

void tell_option(std::ostream& out, const OptionWords& option) {
  out << ".TP\n";
  const std::string names =
      joined(option.names, [&](const std::string& name) { return bold(name); });
  out << names;
  if (!option.value.empty()) out << (names.empty() ? "" : " ") << value_of(option);
  out << "\n" << roff(option.help) << "\n";
}

void tell_synopsis(std::ostream& out, const VerbWords& verb) {
  if (!verb.name.empty()) out << ".br\n";
  out << bold("pedicel");
  if (!verb.name.empty()) out << " " << bold(verb.name);
  out << " [" << italic("option") << " ...]";
  for (const OptionWords& word : verb.words)
    out << " " << (word.needed ? "" : "[") << italic(word.value) << (word.needed ? "" : "]")
        << (word.repeats ? " ..." : "");
  out << "\n";
}

void tell_verb(std::ostream& out, const VerbWords& verb) {
  for (const OptionWords& word : verb.words) tell_option(out, word);
  for (const OptionWords& option : verb.options) tell_option(out, option);
}

}  // namespace

std::string man_page(const CommandWords& words, const std::string& version) {
  std::ostringstream out;
  out << ".\\\" Made by pedicel --man-page.\n"
      << ".TH PEDICEL 1 \"\" \"pedicel " << version << "\" \"User Commands\"\n"
      << ".SH NAME\npedicel \\- a sandbox where robots handle plants\n.SH SYNOPSIS\n";
  tell_synopsis(out, words.program);
  for (const VerbWords& verb : words.verbs) tell_synopsis(out, verb);
  out << ".SH DESCRIPTION\n"
         "Without a verb, pedicel opens a scene in its window. Without a display, or with\n"
      << bold("--headless") << ", it runs the scene off screen and writes a report.\n"
      << ".SH OPTIONS\n";
  tell_verb(out, words.program);
  out << ".SH VERBS\n";
  for (const VerbWords& verb : words.verbs) {
    out << ".SS pedicel " << verb.name << "\n" << roff(verb.help) << "\n";
    tell_verb(out, verb);
  }
  out << ".SH NOTES\n";
  for (std::size_t i = 0; i < words.notes.size(); ++i)
    out << (i > 0 ? ".PP\n" : "") << roff(words.notes[i]) << "\n";
  out << ".SH SEE ALSO\nThe manual is the folder\n"
      << italic("share/pedicel/assets/manual") << "\nbeside the program's folder; begin with\n"
      << italic("index.md") << " there.\n";
  return out.str();
}

}  // namespace pedicel::app
