// Units as headers have them.
#include "engine/io/unit_text.h"

#include <gtest/gtest.h>

namespace pedicel::io {
namespace {

TEST(UnitText, KnowsWhatPeopleWrite) {
  struct Known {
    const char* text;
    Quantity quantity;
    double factor;
  };
  for (const Known& known : {Known{"s", Quantity::time, 1},
                             {"ms", Quantity::time, 1e-3},
                             {"(mm)", Quantity::length, 1e-3},
                             {"[CM]", Quantity::length, 1e-2},
                             {"M", Quantity::length, 1},
                             {"inch", Quantity::length, 0.0254},
                             {"\xC2\xB5m", Quantity::length, 1e-6},
                             {"mN", Quantity::force, 1e-3},
                             {"N", Quantity::force, 1},
                             {"gf", Quantity::force, 9.80665e-3},
                             {"kgf", Quantity::force, 9.80665},
                             {"N m", Quantity::moment, 1},
                             {"Nmm", Quantity::moment, 1e-3},
                             {"mNm", Quantity::moment, 1e-3},
                             {"rad", Quantity::angle, 1},
                             {"1", Quantity::none, 1}}) {
    const auto unit = unit_of(known.text);
    ASSERT_TRUE(unit) << known.text;
    EXPECT_EQ(unit->quantity, known.quantity) << known.text;
    EXPECT_DOUBLE_EQ(unit->factor, known.factor) << known.text;
  }
  EXPECT_NEAR(unit_of("deg")->factor * 180.0, 3.14159265358979, 1e-12);
  EXPECT_FALSE(unit_of("furlong"));
  EXPECT_FALSE(unit_of(""));
}

TEST(UnitText, TakesTheUnitOffAName) {
  EXPECT_EQ(split_unit("x (mm)").name, "x");
  EXPECT_EQ(split_unit("x (mm)").unit, "mm");
  EXPECT_EQ(split_unit("Load Cell [N]").name, "Load Cell");
  EXPECT_EQ(split_unit("x").unit, "");
  EXPECT_EQ(split_unit("(mm)").name, "(mm)");
  EXPECT_EQ(unit_behind("m1.x_mm", "m1.x")->factor, 1e-3);
  EXPECT_EQ(unit_behind("Time_ms", "time")->factor, 1e-3);
  EXPECT_FALSE(unit_behind("x_mm", "y"));
  EXPECT_FALSE(unit_behind("x_left", "x"));
}

}  // namespace
}  // namespace pedicel::io
