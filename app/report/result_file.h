#pragma once

#include <filesystem>
#include <span>

#include "app/report/headless.h"

namespace pedicel::app {

/// The result of a run as a file, so that another process can report it: `expectations` are those
/// of the scene that was run, and pictures lie in `result.folder`. Numbers keep their bits. Throws
/// io::WriteError.
void write_result(const std::filesystem::path& path,
                  std::span<const world::Expectation> expectations, const SceneResult& result);

/// Its files lie in the file's folder. Throws InvalidFile.
SceneResult read_result(const std::filesystem::path& path,
                        std::span<const world::Expectation> expectations);

}  // namespace pedicel::app
