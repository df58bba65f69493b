#pragma once

#include <memory>
#include <string_view>
#include <vector>

namespace pedicel::app {

struct Ui;

/// Where a panel stands.
enum class Dock { left, right, bottom };

/// A tab of the interface. One file each: NAME_panel.cpp defines make_NAME_panel(), and CMake's
/// list of names makes the list of panels.
class Panel {
 public:
  virtual ~Panel() = default;
  virtual std::string_view name() const = 0;  ///< on the tab, and for Ui::show_panel
  virtual Dock dock() const = 0;
  /// Whether there is anything to show (no robot: no robot panel).
  virtual bool useful(const Ui&) const { return true; }
  virtual void draw(Ui& ui) = 0;
  /// When the tab is not in front: what must go on anyway.
  virtual void idle(Ui&) {}
};

/// All panels, in the order of the tabs. Made by CMake from the list of names.
std::vector<std::unique_ptr<Panel>> make_panels();

}  // namespace pedicel::app
