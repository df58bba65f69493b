#include "engine/core/exit_code.h"

namespace pedicel {

std::span<const ExitCodeDescription> exit_codes() {
  static const ExitCodeDescription all[] = {
      {std::to_string(exit_ok), "all is well; `diagnose`: the model is adequate"},
      {std::to_string(exit_failure), "runtime failure"},
      {std::to_string(exit_usage), "usage: an option or a value is wrong"},
      {std::to_string(exit_invalid), "a file is invalid or missing"},
      {std::to_string(exit_unstable), "the simulation is unstable"},
      {std::to_string(exit_unmet),
       "an expectation is not met, or a comparison is beyond its tolerance"},
      {std::to_string(exit_unwritable), "output cannot be written"},
      {std::to_string(exit_cause_named), "`diagnose`: a cause is named"},
      {std::to_string(exit_causes_alike), "`diagnose`: several causes fit alike"},
      {std::to_string(exit_cause_unknown), "`diagnose`: an unknown cause"},
      {std::to_string(exit_unusable_data), "`diagnose`: unusable data"},
      {std::to_string(exit_numerical_error),
       "`diagnose`: the program's own numerical error is too large"},
      {std::to_string(exit_no_pictures), "pictures were asked for, and there is no OpenGL"},
      {std::to_string(exit_signal) + " + signal",
       "a signal stopped it: 130 Ctrl-C, 143 SIGTERM, 129 SIGHUP, 152 SIGXCPU, 141 SIGPIPE"}};
  return all;
}

std::string exit_codes_text() {
  std::string text = "Exit codes:";
  for (const ExitCodeDescription& one : exit_codes())
    text += (text.back() == ':' ? " " : ", ") + one.code + " " + one.meaning;
  std::erase(text, '`');
  return text + ".";
}

}  // namespace pedicel
