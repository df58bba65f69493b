#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace pedicel::app {

/// An option of the command line, or a word that stands without one (then `names` is empty).
struct OptionWords {
  std::vector<std::string> names;    ///< "--help", "-h"
  std::string value;                 ///< what follows: "TEXT", "NUMBER"; empty: nothing does
  std::vector<std::string> choices;  ///< the values that it takes; empty: any
  std::string help;                  ///< one sentence
  bool repeats = false, needed = false;
};

/// `pedicel`, or one of its verbs.
struct VerbWords {
  std::string name;  ///< "sweep"; empty: the program without a verb
  std::string help;  ///< one sentence
  std::vector<OptionWords> options, words;
};

/// All that the command line takes. Help, man page and completion are made of the same
/// description, so that none of them lags behind.
struct CommandWords {
  VerbWords program;
  std::vector<VerbWords> verbs;
  std::vector<std::string> notes;  ///< paragraphs: exit codes, places
};

CommandWords command_words(const CLI::App& app);

}  // namespace pedicel::app
