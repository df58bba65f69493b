#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/skeleton/skeleton.h"

namespace pedicel::plant {

/// A row of a skeleton table: what it is called and what it hangs from.
struct SkeletonRow {
  std::optional<std::int64_t> id;
  std::optional<std::int64_t> parent;  ///< an id; absent: it says that it has none
  SourcePosition where;
};

/// How rows hang together: every row's parent (an index, -1 for the root), and the rows in an order
/// in which parents come first, children in the order of their rows.
struct SkeletonTree {
  std::vector<int> parent;
  std::vector<int> order;
};

/// The root is the one row without a parent, or that names itself, or (where there is none of
/// these) the one whose parent is no row. Ids that appear twice, parents that are not there,
/// several roots and rings go to the diagnostics, and then the tree is empty.
SkeletonTree skeleton_tree(const std::vector<SkeletonRow>& rows, Diagnostics& diagnostics);

}  // namespace pedicel::plant
