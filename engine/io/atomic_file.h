#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace pedicel::io {

/// The output could not be written; exit code 6.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes the whole text beside the target, flushes it to disk, then renames it over the target: a
/// reader sees the old file or the new one, never half of one. Creates missing parent folders.
/// Throws WriteError with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path, const std::string& contents);

/// `to` gets the contents of `from`: by a link where both are on one disk, by a copy elsewhere.
/// Both are final files, which nobody writes to. Creates missing parent folders; replaces what is
/// there. Throws WriteError.
void link_or_copy(const std::filesystem::path& from, const std::filesystem::path& to);

/// Reads a whole file of at most 256 MB. Throws InvalidFile ("cannot be read: reason").
std::string read_file(const std::filesystem::path& path);

}  // namespace pedicel::io
