#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::app {

/// A table that the program reads, told by its header.
enum class TableKind {
  skeleton,
  cylinders,
  markers,
  path,
  force,
  wrench,
  events,
  trajectory,
  unknown
};

/// What a file's header says; nothing where the file is no table (one column, or no text).
std::optional<TableKind> table_kind(const std::filesystem::path& path);

/// "skeleton", "markers", ...: for "FILE: markers, good".
const char* name_of(TableKind kind);

/// Reads a table of a kind as those do who use it, as far as the table alone allows. What is worth
/// knowing of a good one comes back. What nothing reads is an error that names the columns.
std::string check_table(const std::filesystem::path& path, TableKind kind,
                        Diagnostics& diagnostics);

/// Whether a text begins with a command, as scripts do.
bool is_script(const std::filesystem::path& path);
/// Reads every line of a script, and runs none.
std::string check_script(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace pedicel::app
