#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.h"
#include "plant/plant_file.h"
#include "plant/skeleton.h"

/// Digitised plants: the multiscale tree graph of C. Godin and Y. Caraglio, J. Theor. Biol. 191
/// (1998) 1-46, as the text that OpenAlea and AMAPmod write, and tables of nodes.
namespace pedicel::plant {

/// The digitised nodes of an MTG text with the features XX, YY, ZZ (mm) and, where it has it,
/// TopDia (0.1 mm). The column of an entity's code is its place in the tree: "^" follows the entity
/// above in the same column, without it the code hangs from the one in the column before; "+"
/// begins an axis,
/// "<" "<<" and "/" continue it. An entity without coordinates is passed over: what hangs from it
/// hangs from the nearest digitised one above. Lines that start with "#" are comments. Empty after
/// an error; `file` stands for the file in errors.
std::vector<SkeletonNode> parse_mtg(const std::string& text, const std::string& file,
                                    Diagnostics& diagnostics);

/// The nodes of a table with the columns x,y,z,parentid,vid,edgetype (m; "<" follows, "+" branches;
/// the root's parent is empty, nan or -1), or id,parent,x_m,y_m,z_m,is_branch with an optional
/// diameter_m, in any order of rows and columns. Parents come first in the result.
std::vector<SkeletonNode> parse_skeleton_csv(const std::string& text, const std::string& file,
                                             Diagnostics& diagnostics);

/// Reads an MTG text as a plant, see skeleton_plant(). Every fault goes to `diagnostics` with its
/// line and column; nothing comes back where there is one.
std::optional<PlantFile> read_mtg(const std::filesystem::path& path, const MtgOptions& options,
                                  Diagnostics& diagnostics);

/// The same for a table of nodes.
std::optional<PlantFile> read_skeleton_csv(const std::filesystem::path& path,
                                           const MtgOptions& options, Diagnostics& diagnostics);

}  // namespace pedicel::plant
