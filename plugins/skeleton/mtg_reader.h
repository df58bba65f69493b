#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/diagnostics.h"
#include "plugins/plant/plant_file.h"
#include "plugins/skeleton/skeleton.h"

/// Digitised plants: the multiscale tree graph of C. Godin and Y. Caraglio, J. Theor. Biol. 191
/// (1998) 1-46, as the text that OpenAlea and AMAPmod write, and tables of nodes.
namespace pedicel::plant {

/// The digitised nodes of an MTG text with the features XX, YY, ZZ and, where it has one, TopDia
/// (in tenths of their unit), diameter or radius (in their unit). The unit is `unit` (m) where the
/// caller says it, else what a line "UNIT: cm" or a comment "# unit: cm" above the columns says,
/// else mm. The column of an entity's code is its place in the tree: "^" follows the entity above
/// in the same column, without it the code hangs from the one in the column before; "+" begins an
/// axis, "<" "<<" and "/" continue it. An entity without coordinates is passed over: what hangs
/// from it hangs from the nearest digitised one above. Lines that start with "#" are comments.
/// Empty after an error; `file` stands for the file in errors.
std::vector<SkeletonNode> parse_mtg(const std::string& text, const std::string& file,
                                    Diagnostics& diagnostics, double unit = 0.0);

/// The nodes of a table, see io::TableText for the ways of writing one and find_skeleton_columns()
/// for the columns: nodes with x,y,z,parentid,vid,edgetype ("<" follows, "+" branches) and optional
/// diameters, or cylinders of a QSM. The root has no parent, or names itself, or one that is
/// nowhere. `unit` as above; else what the header or a comment says, else m. Parents come first in
/// the result, which is empty after an error.
std::vector<SkeletonNode> parse_skeleton_csv(const std::string& text, const std::string& file,
                                             Diagnostics& diagnostics, double unit = 0.0);

}  // namespace pedicel::plant
