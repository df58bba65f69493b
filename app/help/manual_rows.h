#pragma once

#include <string>
#include <vector>

namespace pedicel::app {

/// A row of a table of the manual, as the program's own descriptions make it.
struct ManualRow {
  std::string page;                ///< "effects"
  int keys = 1;                    ///< the first so many cells say which row it is
  std::vector<std::string> cells;  ///< Markdown
};

/// Every row that comes from a description: effects and their parameters, settings of rods,
/// contact, plants, the scene and the diagnosis, commands of scripts, exit codes.
std::vector<ManualRow> manual_rows();

}  // namespace pedicel::app
