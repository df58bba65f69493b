#pragma once

#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::io {

class YamlNode;

/// A part of a YAML file kept as text until someone reads it who knows what it means. As one flow
/// map or list, whose values stand at the lines and columns that they have in the file.
struct YamlPiece {
  std::string text;
  SourcePosition where;  ///< of the part in its file
};

/// Keeps a node. More than 8 levels, or a text of more than 100 kB, is an error of the node.
YamlPiece piece_of(const YamlNode& node);

/// Reads it again: positions in errors are those of the file.
YamlNode read_piece(const YamlPiece& piece, Diagnostics& diagnostics);

/// In one line, as people write it.
std::string piece_text(const YamlPiece& piece);

}  // namespace pedicel::io
