#include "engine/render/text.h"

#include <gtest/gtest.h>

#include <string>

#include "engine/render/font.h"

namespace pedicel::render {
namespace {

TEST(Font, EveryPrintableCharacterHasAGlyphInsideItsBox) {
  const Glyph& box = glyph(U'\ufffd');
  for (char32_t c = 33; c < 127; ++c) {
    const Glyph& g = glyph(c);
    EXPECT_NE(&g, &box) << static_cast<int>(c);
    ASSERT_FALSE(g.strokes.empty());
    for (const auto& stroke : g.strokes)
      for (const auto& p : stroke) {
        EXPECT_GE(p.x(), 0.0);
        EXPECT_LE(p.x(), g.width);
        EXPECT_GE(p.y(), -font::descent);
        EXPECT_LE(p.y(), font::ascent);
      }
  }
  EXPECT_EQ(&glyph(U'\u4e00'), &box);
}

TEST(Font, DecodesUtf8) {
  EXPECT_EQ(decode_utf8("a\u00b5\u2264\U0001f345"),
            (std::vector<char32_t>{U'a', U'\u00b5', U'\u2264', U'\U0001f345'}));
  EXPECT_EQ(decode_utf8("\xff\xc3"), (std::vector<char32_t>{U'\ufffd', U'\ufffd'}));
}

TEST(Text, DrawsInsideItsBoundsAndReachesThem) {
  const std::string text = "t = 2.31 s  |gjpqy|\nstrain 0.12 / 0.15";
  for (const double height : {7.0, 13.0, 31.5}) {
    const TextStyle style{height};
    const TextSize size = text_size(text, style);
    Image image(900, 200);
    const double x = 20.3, y = 15.7;
    draw_text(image, x, y, text, style);
    int left = 900, right = 0, top = 200, bottom = 0;
    for (int row = 0; row < image.height; ++row)
      for (int column = 0; column < image.width; ++column)
        if (image.at(column, row)[0] > 0) {
          left = std::min(left, column), right = std::max(right, column);
          top = std::min(top, row), bottom = std::max(bottom, row);
        }
    EXPECT_GE(left, static_cast<int>(x));
    EXPECT_LE(right + 1, x + size.width + 1.0);
    EXPECT_GE(top, static_cast<int>(y));
    EXPECT_LE(bottom + 1, y + size.height + 1.0);
    EXPECT_GT(right - left, 0.9 * size.width - 2.0);
    EXPECT_GT(bottom - top, 0.8 * size.height - 2.0);
  }
}

TEST(Text, TakesTheColourAndIsCutOffAtTheEdge) {
  Image image(40, 20);
  TextStyle style{16.0, Colour::hex(0xff0000), 0.3};
  draw_text(image, -10.0, -5.0, "HHHHHHHHHHHHHH", style);
  int full = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    full += image.rgb[i] == 255;
    EXPECT_EQ(image.rgb[i + 1], 0);
  }
  EXPECT_GT(full, 50);
}

TEST(Text, EmptyTextHasNoWidth) {
  EXPECT_EQ(text_size("", {}).width, 0.0);
}

}  // namespace
}  // namespace pedicel::render
