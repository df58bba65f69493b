#include "app/ui/theme.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pedicel::app {
namespace {

/// Relative luminance and contrast: W3C, Web Content Accessibility Guidelines 2.1.
double luminance(const ImVec4& colour) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour.x) + 0.7152 * linear(colour.y) + 0.0722 * linear(colour.z);
}
double contrast(const ImVec4& a, const ImVec4& b) {
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

class Themes : public ::testing::TestWithParam<Theme> {
 protected:
  Themes() : context_(ImGui::CreateContext()) { apply_theme(GetParam(), 1.0f); }
  ~Themes() override { ImGui::DestroyContext(context_); }
  static const ImVec4& colour(ImGuiCol which) { return ImGui::GetStyle().Colors[which]; }
  ImGuiContext* context_;
};

TEST_P(Themes, NumbersCanBeReadOnASlidersGrab) {
  constexpr double small_text = 4.5;  // least contrast by the same guidelines
  for (const ImGuiCol ground : {ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_FrameBg,
                                ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
    EXPECT_GT(contrast(colour(ImGuiCol_Text), colour(ground)), small_text)
        << ImGui::GetStyleColorName(ground);
  EXPECT_GT(contrast(colour(ImGuiCol_SliderGrab), colour(ImGuiCol_FrameBg)), 1.4)
      << "the grab itself is seen";
}

INSTANTIATE_TEST_SUITE_P(Both, Themes, ::testing::Values(Theme::dark, Theme::light));

}  // namespace
}  // namespace pedicel::app
