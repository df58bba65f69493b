#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pedicel::io {

/// The output could not be written; exit code 6.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether a file is to outlast a loss of power from now on: that takes milliseconds, too long for
/// the many pictures of a film.
enum class Durable { no, yes };

/// Writes the whole text beside the target, then renames it over the target: a reader sees the old
/// file or the new one, never half of one, and nothing stays beside it where that fails. Creates
/// missing parent folders. Throws WriteError with the path and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::string_view contents,
                           Durable durable = Durable::yes);

/// Reads a whole file. Throws InvalidFile ("cannot be read: reason").
std::string read_file(const std::filesystem::path& path);

}  // namespace pedicel::io
