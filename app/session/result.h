#pragma once

#include <string>

namespace pedicel::app {

/// What became of a command.
struct Result {
  bool ok = true;
  std::string text;         ///< the fault, or what a query answers; may be empty
  bool bad_file = false;    ///< the fault is one of a file that was to be read
  bool overwrites = false;  ///< refused, since a file would be lost: SaveWishes::overwrite does it
  explicit operator bool() const { return ok; }
};

}  // namespace pedicel::app
