// Section properties against closed forms and tables.
#include "plugins/cosserat/model/section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pedicel::cosserat {
namespace {

constexpr double pi = 3.14159265358979323846;
const Material material{2.0e9, 0.25, 800.0, 0.01};
constexpr double shear_modulus = 0.8e9;  // E / (2 (1 + nu))

TEST(Section, Circle) {
  const double r = 0.01, area = pi * r * r, second = area * r * r / 4;
  const Section s = circle_section(r, material);
  EXPECT_DOUBLE_EQ(s.axial, 2.0e9 * area);
  EXPECT_NEAR(s.bend1 / (2.0e9 * second), 1.0, 1e-14);
  EXPECT_DOUBLE_EQ(s.bend1, s.bend2);
  EXPECT_NEAR(s.twist / (shear_modulus * 2 * second), 1.0, 1e-14);
  EXPECT_DOUBLE_EQ(s.mass, 800.0 * area);
  EXPECT_NEAR(s.inertia3 / (800.0 * 2 * second), 1.0, 1e-14);
  // Cowper (1966), table 1: k = 6 (1 + nu) / (7 + 6 nu).
  EXPECT_NEAR(s.shear1 / (shear_modulus * area), 6 * 1.25 / (7 + 6 * 0.25), 1e-14);
  EXPECT_DOUBLE_EQ(s.shear1, s.shear2);
}

TEST(Section, EllipseBendsMostEasilyAboutItsLongAxis) {
  const double a = 0.02, b = 0.01;
  const Section s = ellipse_section(a, b, material);
  EXPECT_NEAR(s.bend1, 2.0e9 * pi / 4 * a * b * b * b, 1e-9);
  EXPECT_NEAR(s.bend2, 2.0e9 * pi / 4 * a * a * a * b, 1e-9);
  EXPECT_NEAR(s.twist / (shear_modulus * pi * std::pow(a * b, 3) / (a * a + b * b)), 1.0, 1e-14);
  const Section turned = ellipse_section(b, a, material);
  EXPECT_DOUBLE_EQ(s.bend1, turned.bend2);
  EXPECT_DOUBLE_EQ(s.shear1, turned.shear2);
}

// Timoshenko & Goodier, Theory of Elasticity, section 109: J = k (short side)^3 (long side).
TEST(Section, TorsionConstantsOfRectangles) {
  struct Row {
    double ratio, k;
  };
  for (const Row& row : {Row{1.0, 0.1406}, Row{2.0, 0.229}, Row{5.0, 0.291}, Row{10.0, 0.312}}) {
    const double h = 0.01, w = row.ratio * h;
    for (const Section& s : {rectangle_section(w, h, material), rectangle_section(h, w, material)})
      EXPECT_NEAR(s.twist / (shear_modulus * w * h * h * h), row.k, 6e-4) << row.ratio;
  }
}

TEST(Section, RectangleBendsAboutTheAxisOfItsLongExtent) {
  const Section s = rectangle_section(0.04, 0.01, material);
  EXPECT_NEAR(s.bend1, 2.0e9 * 0.04 * 1e-6 / 12, 1e-9);
  EXPECT_NEAR(s.bend2, 2.0e9 * 0.01 * 64e-6 / 12, 1e-9);
  // Cowper (1966), table 1: k = 10 (1 + nu) / (12 + 11 nu).
  EXPECT_NEAR(s.shear1 / (shear_modulus * 4e-4), 12.5 / 14.75, 1e-14);
}

}  // namespace
}  // namespace pedicel::cosserat
