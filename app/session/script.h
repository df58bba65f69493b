#pragma once

#include <filesystem>
#include <ostream>

#include "app/session/session.h"

namespace pedicel::app {

/// Runs a script of commands, one a line ("#" begins a comment), on a session whose commands wait.
/// It ends at the first line that cannot be done; that is said as `file:line:column: error: ...` on
/// `errors`, answers go to `out`. Returns an exit code: 0, 1 a command failed, 3 a line is none,
/// 4 the simulation is unstable, 5 an `expect` is not met. Throws
/// InvalidFile where the script cannot be read.
int run_script(const std::filesystem::path& file, Session& session, std::ostream& out,
               std::ostream& errors);

}  // namespace pedicel::app
