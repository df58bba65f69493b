#pragma once

#include <filesystem>

#include "app/report/headless.h"

namespace pedicel::app {

/// Writes the sidecar of log.csv: version, seed, step, hash, machine, and every described parameter
/// with its value and unit, so that a run can be repeated. Throws io::WriteError.
void write_meta(const std::filesystem::path& path, const simulation::Simulation& simulation,
                const SceneResult& result);

}  // namespace pedicel::app
