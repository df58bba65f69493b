#pragma once

#include <optional>
#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::robot {

/// A URDF file's bytes as XML that TinyXML reads: entities that a DOCTYPE defines are put in their
/// places, and the DOCTYPE goes; bytes that are no UTF-8 are '?', with a warning. What is no XML at
/// all is said in plain words (a Git LFS pointer, UTF-16, an empty file, a web page), and nothing
/// comes back.
std::optional<std::string> urdf_xml_text(const std::string& bytes, const std::string& file,
                                         Diagnostics& diagnostics);

}  // namespace pedicel::robot
