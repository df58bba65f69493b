#pragma once

#include <filesystem>
#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::app {

/// A table that the program reads, told by its header.
struct TableKind {
  const char* name;  ///< for "FILE: markers, good"
  /// Reads it as those do who use it, as far as the table alone allows. What is worth knowing of a
  /// good one comes back. nullptr: it is a plant, whose skeleton or cylinders are read and built.
  std::string (*check)(const std::filesystem::path& path, Diagnostics& diagnostics);
};

/// What nothing reads is an error that names the columns.
extern const TableKind unknown_table;

/// What a file's header says; nullptr where the file is no table (one column, or no text).
const TableKind* table_kind(const std::filesystem::path& path);

/// Whether a text begins with a command, as scripts do.
bool is_script(const std::filesystem::path& path);
/// Reads every line of a script, and runs none.
std::string check_script(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace pedicel::app
