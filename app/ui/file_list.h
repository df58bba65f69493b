#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pedicel::app {

struct Ui;

/// Folders and files to choose from, with a line to type a path into.
class FileList {
 public:
  /// Draws it into the current window. The file that was chosen, once. `robots`: URDFs are listed.
  std::optional<std::filesystem::path> draw(Ui& ui, bool saves, bool robots = false);

 private:
  struct Entry {
    std::filesystem::path path;
    bool is_folder = false;
  };
  void read();
  bool robots_ = false;

  std::filesystem::path folder_;
  std::string typed_, problem_;
  std::vector<Entry> entries_;
};

}  // namespace pedicel::app
