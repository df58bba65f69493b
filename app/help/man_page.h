#pragma once

#include <string>

#include "app/help/command_words.h"

namespace pedicel::app {

/// pedicel(1) as roff.
std::string man_page(const CommandWords& words, const std::string& version);

}  // namespace pedicel::app
