#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace pedicel::app {

class Platform;
class ScenePane;
struct Ui;

/// What the window shows of the document that is open: title, first camera, what is new in it.
class ShownDocument {
 public:
  /// Another document: its own first camera, and nothing chosen. The same one read anew keeps both.
  /// What was imported is brought into the picture.
  void follow(Ui& ui, Platform& platform, ScenePane& scene);

 private:
  std::filesystem::path path_;
  std::set<std::string> plants_;  // that were in the picture last
  bool framed_ = false;
};

}  // namespace pedicel::app
