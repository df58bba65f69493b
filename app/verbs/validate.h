#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace pedicel::app {

/// Loads and checks files without running them: plants (built, and how far they settle from their
/// drawing), scenes (with everything that they name and whether the robot reaches its waypoints),
/// leaf templates, robots, meshes, experiments (the file or its folder), tables (skeletons,
/// cylinders, markers, paths, forces, events, trajectories) and scripts. The kind is told by
/// `format:`, by the extension, or by what stands in the file: a table by its header. `packages` as
/// for `--package`, `unit` (m) as for `--unit`. Writes one line a problem and one a file that is
/// good; returns the exit code: 0, or 3 where any file is bad. What nothing reads is bad.
int validate_files(const std::vector<std::string>& files, const std::vector<std::string>& packages,
                   std::ostream& out, double unit = 0.0);

}  // namespace pedicel::app
