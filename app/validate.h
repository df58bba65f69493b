#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace pedicel::app {

/// Loads and checks files without running them: plants (built, and how far they settle from their
/// drawing), scenes (with everything that they name and whether the robot reaches its waypoints),
/// leaf templates, robots, experiments (the file or its folder). The kind is told by `format:`, or
/// by the extension (.urdf, .csv, .mtg). `packages` as for `--package`. Writes one line a problem
/// and one a file that is good; returns the exit code: 0, or 3 where any file is bad.
int validate_files(const std::vector<std::string>& files, const std::vector<std::string>& packages,
                   std::ostream& out);

}  // namespace pedicel::app
