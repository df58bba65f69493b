#include "app/window/window_painter.h"

#include <imgui.h>

#include "app/ui/theme.h"

namespace pedicel::app {

WindowPainter::WindowPainter(Platform& platform) : platform_(platform) {
  if (platform.gl()) painter_ = std::make_unique<GuiPainter>(*platform.gl());
}

void WindowPainter::take_letters() {
  if (painter_) painter_->upload(*ImGui::GetIO().Fonts);
}

/// Whether the window would look otherwise than it was painted last. Now and then it is painted
/// anyway, for window systems that forget what was covered.
bool WindowPainter::has_to_paint(double now, bool anew) {
  constexpr double at_least_every = 0.5;  // s
  const std::uint64_t key = interface_key(*ImGui::GetDrawData());
  const bool same = key == painted_key_ && !anew && target_ &&
                    target_->width() == platform_.size()[0] &&
                    target_->height() == platform_.size()[1];
  if (same && now - painted_at_ < at_least_every) return false;
  painted_key_ = key;
  painted_at_ = now;
  return true;
}

bool WindowPainter::paint(double now, bool anew) {
  if (!painter_) {
    platform_.present(nullptr);
    return false;
  }
  if (!has_to_paint(now, anew)) {
    platform_.rest();
    return false;
  }
  const auto [width, height] = platform_.size();
  if (width < 1 || height < 1) return false;
  if (!target_ || target_->width() != width || target_->height() != height) {
    target_.reset();
    target_ = std::make_unique<render::RenderTarget>(*platform_.gl(), width, height, 1);
  }
  target_->bind();
  const ImVec4& back = palette().window;
  platform_.gl()->ClearColor(back.x, back.y, back.z, 1.0f);
  platform_.gl()->Clear(GL_COLOR_BUFFER_BIT);
  painter_->paint(*ImGui::GetDrawData());
  return true;
}

void WindowPainter::present() {
  platform_.present(target_.get());
}

std::optional<render::Image> WindowPainter::picture() const {
  if (!target_) return {};
  return target_->read();
}

}  // namespace pedicel::app
