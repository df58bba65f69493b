#include "app/help/command_words.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace pedicel::app {

namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

/// Of "TEXT:{dark,light}" the two words.
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  return split(type.substr(open + 1, close - open - 1), ',');
}

OptionWords option_words(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  const std::string type = option.get_type_name();
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value) words.value = option.get_positional() ? option.get_name(true) : type;
  if (const std::size_t colon = words.value.find(':'); colon != std::string::npos)
    words.value.resize(colon);
  words.choices = choices_of(type);
  words.help = option.get_description();
  words.repeats = option.get_items_expected_max() > 1;
  words.needed = option.get_required();
  return words;
}

VerbWords verb_words(const CLI::App& app) {
  VerbWords verb{app.get_name(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? verb.words : verb.options).push_back(option_words(*option));
  return verb;
}

}  // namespace

CommandWords command_words(const CLI::App& app) {
  CommandWords all{verb_words(app), {}, split(app.get_footer(), '\n')};
  all.program.name.clear();
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    all.verbs.push_back(verb_words(*verb));
  return all;
}

}  // namespace pedicel::app
