#include "engine/render/overlay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/render/colormap.h"

namespace pedicel::render {
namespace {

Image grey(int width, int height) {
  Image image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{200});
  return image;
}

/// Whether every pixel outside the area is as it was, and some inside are not.
void expect_only_inside(const Image& image, const Area& area) {
  int changed = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const bool inside =
          x + 1 > area.x && x < area.x + area.width && y + 1 > area.y && y < area.y + area.height;
      const bool same = image.at(x, y)[0] == 200 && image.at(x, y)[1] == 200;
      ASSERT_TRUE(inside || same) << x << ", " << y;
      changed += !same;
    }
  EXPECT_GT(changed, 100);
}

TEST(Overlay, CaptionStaysOnItsPanelInEveryCorner) {
  for (const Corner corner :
       {Corner::top_left, Corner::top_right, Corner::bottom_left, Corner::bottom_right}) {
    Image image = grey(640, 360);
    const Area area = draw_caption(image, "t = 2.31 s  stalk strain 0.12 / 0.15", corner);
    const bool right = corner == Corner::top_right || corner == Corner::bottom_right;
    const bool bottom = corner == Corner::bottom_left || corner == Corner::bottom_right;
    EXPECT_EQ(area.x + 0.5 * area.width > 320, right);
    EXPECT_EQ(area.y + 0.5 * area.height > 180, bottom);
    EXPECT_GE(area.x, 0.0);
    EXPECT_LE(area.x + area.width, 640.0);
    expect_only_inside(image, area);
  }
}

TEST(Overlay, LegendShowsTheColoursOfTheScale) {
  Image image = grey(640, 360);
  const Area area = draw_legend(image, {"strain (1)", 0.0, 0.2, 0.15}, Corner::bottom_right);
  expect_only_inside(image, area);
  const auto shown = [&](const Colour& colour) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3)
      if (std::abs(image.rgb[i] - 255.0f * colour.r) < 3 &&
          std::abs(image.rgb[i + 1] - 255.0f * colour.g) < 3 &&
          std::abs(image.rgb[i + 2] - 255.0f * colour.b) < 3)
        return true;
    return false;
  };
  for (const double fraction : {0.01, 0.25, 0.5, 0.99})
    EXPECT_TRUE(shown(strain_colour(fraction))) << fraction;
}

TEST(Overlay, LabelOnlyWhereThePointIsSeen) {
  const Camera camera{Vec3(0, -2, 0), Vec3::Zero()};
  Image image = grey(320, 240);
  EXPECT_FALSE(draw_label(image, camera, Vec3(0, -3, 0), "behind"));
  EXPECT_FALSE(draw_label(image, camera, Vec3(50, 0, 0), "beside"));
  EXPECT_EQ(image.rgb, grey(320, 240).rgb);
  EXPECT_TRUE(draw_label(image, camera, Vec3(0, 0, 0), "plant/stem"));
  EXPECT_EQ(image.at(160, 120)[0], 255) << "no dot at the point";
}

}  // namespace
}  // namespace pedicel::render
