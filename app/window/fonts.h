#pragma once

#include <string>

struct ImFont;

namespace pedicel::app {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* bold = nullptr;  ///< headings; the same as `text` where there is none
  std::string file;        ///< where `text` comes from; empty: ImGui's own
};

/// Puts the letters for a text of that height (px) into the current context's atlas, from the first
/// of the known Debian packages that is there (fonts-roboto-unhinted, fonts-dejavu-core, ...), else
/// ImGui's own. What was there before is dropped.
Fonts load_fonts(double height);

}  // namespace pedicel::app
