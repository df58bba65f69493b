#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace pedicel::io {

/// A folder that one run writes to. A hidden list in it, `.pedicel-files`, names every file that
/// the run makes, before it is made; so the next run into the folder can take away what that one
/// left, a killed one's files too, and nothing else. What is not on the list is never touched.
class OutputFolder {
 public:
  /// Takes the folder, which is made where it is not there, and takes away what an earlier run
  /// left. Throws WriteError where another run is writing there, where one of `names` is there and
  /// on no list (somebody else's), and where nothing can be written.
  OutputFolder(std::filesystem::path folder, const std::vector<std::string>& names);
  /// The list stays; the folder is free for the next run.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return folder_; }
  /// "out/pull: replaces the run of 2026-11-26 20:15 (12 files)"; empty: there was none.
  const std::string& replaced() const { return replaced_; }

  /// The path of a file that the run is about to write, put on the list. A name that ends in "/" is
  /// a folder of the run's own: one taken by another OutputFolder, or one of numbered pictures.
  /// Throws WriteError where somebody else's file has that name.
  std::filesystem::path file(const std::string& name);

 private:
  void remove_earlier_run();
  void check_free(const std::string& name) const;
  void append(const std::string& line);

  std::filesystem::path folder_;
  std::string replaced_;
  std::set<std::string> own_;
  int list_ = -1;  // file descriptor, locked
};

/// For what is written in one go at the end: `write` makes its files in an empty folder beside, and
/// once all are whole they are moved into `folder`, taken as above. Comes back with replaced().
/// Throws WriteError, and what `write` throws; `folder` is as it was then.
std::string write_folder(const std::filesystem::path& folder,
                         const std::function<void(const std::filesystem::path&)>& write);

/// A file's name without the ending that says its kind: "pull_0.1" of pull_0.1.scene.yaml and of
/// pull_0.1. Known: .scene.yaml, .plant.yaml, .leaf.yaml, .yaml, .yml, .csv, .mtg.
std::string name_of_file(const std::filesystem::path& path);

}  // namespace pedicel::io
