#pragma once

#include <filesystem>
#include <string>

namespace pedicel::app {

/// STEM_001ENDING, or the first number that is free.
std::filesystem::path free_file_name(const std::string& stem, const std::string& ending);

}  // namespace pedicel::app
