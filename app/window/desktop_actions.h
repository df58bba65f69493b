#pragma once

#include "app/ui/bindings.h"

namespace pedicel::app {

class Platform;
class ScenePane;
class WindowFilm;
class WindowPainter;
struct Ui;

/// What keys and buttons ask the window for.
class DesktopActions {
 public:
  /// Keeps references to all.
  DesktopActions(Ui& ui, Platform& platform, ScenePane& scene, const WindowPainter& window,
                 WindowFilm& film)
      : ui_(ui), platform_(platform), scene_(scene), window_(window), film_(film) {}

  /// Asks for what the keys that are pressed in this picture mean.
  void ask_by_keys();
  /// Does what was asked for since.
  void perform_all();
  /// Whether the user left.
  bool quits() const { return quits_; }

 private:
  void perform(Action action);
  void perform_file(Action action);
  void perform_view(Action action);
  void perform_edit(Action action);
  void take_screenshot();

  Ui& ui_;
  Platform& platform_;
  ScenePane& scene_;
  const WindowPainter& window_;
  WindowFilm& film_;
  bool quits_ = false, full_screen_ = false;
};

}  // namespace pedicel::app
