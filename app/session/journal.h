#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/session/document/document.h"

namespace pedicel::app {

/// The document's plants, settings and waypoints as commands that set them, a line each.
std::string state_commands(const Document& document);

/// What a killed program leaves: a file that holds the document as it was opened or saved last, as
/// commands, and then every command since, each written and flushed to disk as it is done. A line
/// counts once its end is there. The file is locked while its program lives.
///
///     # pedicel journal 1
///     # document /path/to/scene.yaml
///     set plant tomato "format: ..."
///     # base
///     move point tomato stem 2 0.01,0,0.2 #0123456789abcdef     (the document's hash after it)
class Journal {
 public:
  explicit Journal(std::filesystem::path folder);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Begins anew with this document; the file before goes. Throws io::WriteError.
  void begin(const Document& document);
  /// Throws io::WriteError.
  void add(const std::string& command, std::uint64_t hash);
  /// Nothing is to be recovered: takes the file away.
  void close();

  const std::filesystem::path& file() const { return file_; }

 private:
  void open();

  std::filesystem::path folder_, file_;
  int descriptor_ = -1;
};

/// A journal as it is read back; half a line at its end is left out.
struct JournalContent {
  std::filesystem::path document;  ///< that was open; empty: none
  struct Line {
    std::string command;
    std::optional<std::uint64_t> hash;
  };
  std::vector<Line> base, commands;
};
/// Throws InvalidFile where the file cannot be read or is no journal.
JournalContent read_journal(const std::filesystem::path& file);

/// Journals in a folder that no program holds any more, the newest first.
std::vector<std::filesystem::path> lost_journals(const std::filesystem::path& folder);

}  // namespace pedicel::app
