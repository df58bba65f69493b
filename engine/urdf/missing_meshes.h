#pragma once

#include <string>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::robot {

/// A mesh that a link names and that cannot be had.
struct MissingMesh {
  SourcePosition where;
  std::string link, name;  ///< `name` as the URDF writes it
  std::string package;     ///< empty: none
  std::string reason;      ///< "not found", "a Git LFS pointer"; the same words count together
  std::string looked_in;   ///< places where it was looked for; may be empty
  std::string advice;      ///< what to do about it; may be empty
  bool collision = false;  ///< of a collision: the link is without contact there
};

/// One warning a package and reason: how many meshes, the first of them, which links lose their
/// contact, and what to do.
void report_missing(const std::vector<MissingMesh>& all, Diagnostics& diagnostics);

}  // namespace pedicel::robot
