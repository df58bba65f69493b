#pragma once

#include <span>
#include <string>

namespace pedicel {

/// How the program ends. What is said of them, in the help and in the manual, is exit_codes().
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,
  exit_usage = 2,
  exit_invalid = 3,
  exit_unstable = 4,
  exit_unmet = 5,
  exit_unwritable = 6,
  exit_cause_named = 10,
  exit_causes_alike = 11,
  exit_cause_unknown = 12,
  exit_unusable_data = 13,
  exit_numerical_error = 14,
  exit_no_pictures = 77,
  exit_signal = 128,  ///< plus the signal
};

struct ExitCodeDescription {
  std::string code;  ///< "3", "128 + signal"
  std::string meaning;
};
std::span<const ExitCodeDescription> exit_codes();
/// All of them as one paragraph.
std::string exit_codes_text();

}  // namespace pedicel
