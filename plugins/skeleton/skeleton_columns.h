#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"
#include "engine/io/table_text.h"

namespace pedicel::plant {

/// What a column of a skeleton table can be.
enum class ColumnRole {
  id,
  parent,
  x,
  y,
  z,
  edge,
  diameter,
  radius,
  code,  // of a table of nodes
  start_x,
  start_y,
  start_z,
  end_x,
  end_y,
  end_z,  // of a table of cylinders
  axis_x,
  axis_y,
  axis_z,
  length,
  branch,
  order,
  extension,
  count
};

/// Where each of them stands in a table, -1 where it does not, and what a number in it is in
/// metres.
struct SkeletonColumns {
  enum class Kind { none, nodes, cylinders };
  Kind kind = Kind::none;
  std::array<int, static_cast<std::size_t>(ColumnRole::count)> at;
  std::array<double, static_cast<std::size_t>(ColumnRole::count)> unit;

  bool has(ColumnRole role) const { return at[static_cast<std::size_t>(role)] >= 0; }
  int column(ColumnRole role) const { return at[static_cast<std::size_t>(role)]; }
  double factor(ColumnRole role) const { return unit[static_cast<std::size_t>(role)]; }
};

/// Told from the names, whatever their capitals, separators and the program that wrote them: our
/// own and TomatoWUR's (x,y,z,parentid,vid,edgetype), TreeQSM's, SimpleForest's, rTwig's and
/// aRchi's cylinders. `unit` is what the caller says of the lengths (m; 0: nothing), beside what
/// the table says. What is missing, contradicts or is not read goes to the diagnostics.
SkeletonColumns find_skeleton_columns(const io::TableText& table, double unit,
                                      Diagnostics& diagnostics);

/// Whether names of columns are those of a skeleton, as far as it takes to tell it from other
/// tables: coordinates and a parent.
bool looks_like_skeleton(const std::vector<std::string>& names);

}  // namespace pedicel::plant
