#include "engine/render/colormap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/render/colour_space.h"

namespace pedicel::render {
namespace {

TEST(Colormap, LightnessRisesLinearlyFrom25To91) {
  for (int i = 0; i <= 100; ++i)
    EXPECT_NEAR(lightness(strain_colour(i / 100.0)), 25.0 + 66.0 * i / 100.0, 0.5) << i;
}

TEST(Colormap, NeighboursDifferLittleAndEndsMuch) {
  for (int i = 0; i < 255; ++i) {
    const Colour a = strain_colour(i / 255.0), b = strain_colour((i + 1) / 255.0);
    EXPECT_LT(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 0.08) << i;
  }
  EXPECT_GT(strain_colour(0.0).b, strain_colour(0.0).g + 0.2f);  // violet
  EXPECT_GT(strain_colour(1.0).g, strain_colour(1.0).b + 0.2f);  // yellow
}

TEST(Colormap, ClampsAndShowsNothingAsGrey) {
  EXPECT_EQ(strain_colour(7.0).g, strain_colour(1.0).g);
  EXPECT_EQ(strain_colour(-7.0).g, strain_colour(0.0).g);
  const Colour none = strain_colour(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(none.r, none.g);
  EXPECT_EQ(none.g, none.b);
}

TEST(ColourSpace, TransferFunctionHasAnInverse) {
  for (int i = 0; i <= 255; ++i)
    EXPECT_NEAR(from_linear(to_linear(static_cast<float>(i) / 255.0f)) * 255.0f, i, 1e-2);
}

// White has L* = 100, and the grey that reflects 18.4 % of the light has L* = 50 (CIE 1976).
TEST(ColourSpace, KnownLightnesses) {
  EXPECT_NEAR(lightness({1.0f, 1.0f, 1.0f}), 100.0, 1e-3);
  const float grey = from_linear(0.18419f);
  EXPECT_NEAR(lightness({grey, grey, grey}), 50.0, 0.01);
}

}  // namespace
}  // namespace pedicel::render
