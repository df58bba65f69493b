#pragma once

#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/skeleton/skeleton.h"

namespace pedicel::plant {

/// The skeleton in a PLY file's bytes, ASCII or binary: vertices (x, y, z; radius or diameter) and
/// edges (vertex1 and vertex2, or a list of vertices; radius or diameter). What makes a tree of it,
/// see rooted_tree(). Lengths are in `unit` (m) where the caller says it, else in what a line
/// "comment unit: mm" says, else in m. Where neither vertices nor edges have a radius, a line
/// "comment radius: 0.004" says it for all of them; without it that is an error. Empty after an
/// error; `file` stands for the file in errors.
std::vector<SkeletonNode> parse_ply_skeleton(const std::string& bytes, const std::string& file,
                                             Diagnostics& diagnostics, double unit = 0.0);

}  // namespace pedicel::plant
