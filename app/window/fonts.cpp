#include "app/window/fonts.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace pedicel::app {

namespace {

struct Family {
  const char* text;
  const char* bold;
};

constexpr std::array<Family, 4> families = {{
    {"/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
     "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Medium.ttf"},
    {"/usr/share/fonts/truetype/open-sans/OpenSans-Regular.ttf",
     "/usr/share/fonts/truetype/open-sans/OpenSans-Semibold.ttf"},
    {"/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
     "/usr/share/fonts/truetype/noto/NotoSans-Bold.ttf"},
    {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
     "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"},
}};

/// Latin, Greek, dashes, powers, comparisons.
constexpr ImWchar letters[] = {0x0020, 0x00FF, 0x0370, 0x03FF, 0x2010, 0x2027, 0x2070,
                               0x209F, 0x2212, 0x2212, 0x2248, 0x2265, 0};

ImFont* add(const char* file, float height) {
  if (!std::filesystem::exists(file)) return nullptr;
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  config.PixelSnapH = true;
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(file, height, &config, letters);
}

}  // namespace

Fonts load_fonts(double height) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  Fonts fonts;
  const float px = std::round(static_cast<float>(height));
  for (const Family& family : families) {
    fonts.text = add(family.text, px);
    if (!fonts.text) continue;
    fonts.file = family.text;
    fonts.bold = add(family.bold, px);
    break;
  }
  if (!fonts.text) {
    ImFontConfig config;
    config.SizePixels = px;
    fonts.text = atlas.AddFontDefault(&config);
  }
  if (!fonts.bold) fonts.bold = fonts.text;
  atlas.Build();
  return fonts;
}

}  // namespace pedicel::app
