#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "app/platform/platform.h"
#include "app/window/gui_painter.h"

namespace pedicel::app {

/// Paints the interface that ImGui drew, and shows it. On the null platform there is nothing to
/// paint on.
class WindowPainter {
 public:
  /// Keeps a reference. Throws std::runtime_error where the driver refuses our shaders.
  explicit WindowPainter(Platform& platform);

  bool can_paint() const { return painter_ != nullptr; }
  /// Takes over ImGui's letters, as they are now.
  void take_letters();
  /// Paints at the time `now` (s), unless the window would look as it does: `anew` where something
  /// in it is another. Whether it did; present() has to follow then.
  bool paint(double now, bool anew);
  void present();
  /// s, of the last one; below 0: none.
  double painted_at() const { return painted_at_; }

  /// What was painted last, null before that.
  const render::RenderTarget* target() const { return target_.get(); }
  std::optional<render::Image> picture() const;

 private:
  bool has_to_paint(double now, bool anew);

  Platform& platform_;
  std::unique_ptr<GuiPainter> painter_;
  std::unique_ptr<render::RenderTarget> target_;
  std::uint64_t painted_key_ = 0;  // of the interface as it was painted last
  double painted_at_ = -1.0;       // s
};

}  // namespace pedicel::app
