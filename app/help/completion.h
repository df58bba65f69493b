#pragma once

#include <string>

#include "app/help/command_words.h"

namespace pedicel::app {

/// A script for bash that completes verbs, options, values with a fixed choice, and files.
std::string bash_completion(const CommandWords& words);
/// The same for zsh, with what each of them does.
std::string zsh_completion(const CommandWords& words);

}  // namespace pedicel::app
