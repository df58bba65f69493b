// Bars that are dragged: a press changes nothing, and a hand's width of two px little.
#include "app/ui/drag_bar.h"

#include "app/session/session_tuning.h"
#include "tests/app/desk.h"
#include "tests/app/words.h"

namespace pedicel::app {
namespace {

constexpr double width = 200.0;

TEST(DraggedValue, FollowsThePointerFromTheValueThatIsThere) {
  const BarRange linear{10.0, 30.0};
  EXPECT_EQ(dragged_value(17.123456, 0.0, width, 1.0, linear), 17.123456);
  EXPECT_NEAR(dragged_value(17.0, 20.0, width, 1.0, linear), 19.0, 1e-9);
  EXPECT_EQ(dragged_value(17.0, 1e4, width, 1.0, linear), 30.0);
  EXPECT_EQ(dragged_value(17.0, -1e4, width, 1.0, linear), 10.0);
}

// Nine decades on 200 px would be a factor of 1.1 a px; on more px a decade it is finer.
TEST(DraggedValue, TwoPxChangeALogarithmicOneByLessThanFourPercent) {
  const BarRange wide{1e3, 1e12, true}, narrow{0.2, 30.0, true};
  for (const double scale : {1.0, 2.0}) {
    EXPECT_NEAR(dragged_value(4.5e8, 2.0, width, scale, wide) / 4.5e8, 1.02, 0.0199);
    EXPECT_NEAR(dragged_value(3.0, 2.0, width, scale, narrow) / 3.0, 1.02, 0.0199);
  }
  EXPECT_GT(dragged_value(4.5e8, 1.0, width, 1.0, wide), 4.5e8);
  EXPECT_EQ(dragged_value(4.5e8, 1e6, width, 1.0, wide), 1e12);
}

TEST(DraggedValue, ALogarithmicOneComesToItsLowerEndAndBack) {
  const BarRange from_zero{0.0, 10.0, true};
  EXPECT_EQ(dragged_value(1e-3, -1e6, width, 1.0, from_zero), 0.0);
  EXPECT_GT(dragged_value(0.0, 5.0, width, 1.0, from_zero), 0.0);
}

TEST(DraggedValue, WholeNumbersStayWhole) {
  const BarRange whole{1.0, 50.0, false, true};
  const double value = dragged_value(4.0, 13.0, width, 1.0, whole);
  EXPECT_EQ(value, std::round(value));
  EXPECT_EQ(value, 7.0);
}

class Bars : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.draw_coarsely();
    desk_.open(scene_file("cherry_tomato_pull_aside.scene.yaml"));
    desk_.show("Tune");
    const auto caption = place_of("right", "material.youngs_modulus");
    ASSERT_TRUE(caption);
    bar_ = ImVec2(caption->x, caption->y + 0.5f * ImGui::GetFontSize() + 12.0f);
  }
  double modulus() {
    for (const SessionParameter& p : desk_.session().tuning().parameters())
      if (p.key.ends_with("material.youngs_modulus")) return p.value;
    return 0.0;
  }
  Desk desk_;
  ImVec2 bar_;
};

TEST_F(Bars, APressAloneChangesNothingAndTwoPxChangeLittle) {
  const double before = modulus();
  desk_.move(bar_.x, bar_.y);
  desk_.button(0, true);
  desk_.frames(3);
  EXPECT_EQ(modulus(), before);
  EXPECT_EQ(desk_.session().history().size(), 0u);
  desk_.move(bar_.x + 2, bar_.y);
  const double moved = modulus();
  EXPECT_GT(moved, before) << "the bar is not where the test looks for it";
  EXPECT_LT(moved, 1.05 * before);
  desk_.frames(5);  // "reset" stands beside it now
  EXPECT_EQ(modulus(), moved) << "the bar got shorter in the hand";
  desk_.move(bar_.x, bar_.y);
  EXPECT_EQ(modulus(), before);
  desk_.move(bar_.x + 30, bar_.y);
  desk_.button(0, false);
  desk_.settle();
  EXPECT_EQ(desk_.session().history().size(), 1u) << "one drag is one step";
}

TEST_F(Bars, ATypedValueIsTakenOnceAndStartsFromTheOneThatIsThere) {
  desk_.move(bar_.x, bar_.y);
  desk_.hold(Key::left_control, true);
  desk_.button(0, true);
  desk_.button(0, false);
  desk_.hold(Key::left_control, false);
  desk_.frames(2);
  const double before = modulus();
  desk_.type("7,5e8");
  EXPECT_EQ(modulus(), before) << "not while it is typed";
  desk_.key(Key::enter);
  desk_.settle();
  EXPECT_EQ(modulus(), 7.5e8);
  EXPECT_EQ(desk_.session().history().size(), 1u);
}

}  // namespace
}  // namespace pedicel::app
