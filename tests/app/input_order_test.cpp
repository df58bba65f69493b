// Keys that come and go between two pictures, as on a machine that draws ten a second: each does
// what it was pressed for, in its order.
#include "tests/app/desk.h"

namespace pedicel::app {
namespace {

class InputOrder : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!desk_.available()) GTEST_SKIP() << desk_.why();
    desk_.open_empty();
    for (const char* line : {"new plant p", "draw stem p stem 0,0,0;0,0,0.15;0,0,0.3 0.004",
                             "draw stem p twig 0,0,0.2;0.1,0,0.25 0.002"})
      ASSERT_TRUE(desk_.session().run_text(line).ok);
    desk_.settle();
  }
  /// All of them between two pictures.
  void at_once(const std::vector<std::pair<Key, bool>>& keys) {
    for (const auto& [key, pressed] : keys) desk_.send(InputEvent::press(key, pressed));
    desk_.drain();
  }
  std::size_t stems() { return desk_.session().document().plant("p").curves.size(); }
  static constexpr bool down = true, up = false;
  Desk desk_;
};

TEST_F(InputOrder, AChordWithinOnePicture) {
  at_once({{Key::left_control, down}, {Key::z, down}, {Key::z, up}, {Key::left_control, up}});
  EXPECT_EQ(stems(), 1u);
}

TEST_F(InputOrder, AChordWhoseCtrlIsLetGoFirst) {
  desk_.hold(Key::left_control, true);
  at_once({{Key::z, down}, {Key::left_control, up}, {Key::z, up}});
  EXPECT_EQ(stems(), 1u);
}

TEST_F(InputOrder, TwoChordsAndAKeyWithinOnePicture) {
  at_once({{Key::left_control, down},
           {Key::z, down},
           {Key::z, up},
           {Key::z, down},
           {Key::z, up},
           {Key::left_shift, down},
           {Key::z, down},
           {Key::left_shift, up},
           {Key::z, up},
           {Key::left_control, up},
           {Key::d, down},
           {Key::d, up}});
  EXPECT_EQ(stems(), 1u) << "undone twice, done again once";
  EXPECT_TRUE(desk_.ui().draw.on) << "D alone after the chord";
}

TEST_F(InputOrder, AKeyBeforeACtrlIsNoChord) {
  at_once({{Key::d, down}, {Key::left_control, down}, {Key::d, up}, {Key::left_control, up}});
  EXPECT_TRUE(desk_.ui().draw.on);
}

TEST_F(InputOrder, PressAndReleaseAreNeverInOnePicture) {
  desk_.send(InputEvent::press(Key::z, true));
  desk_.send(InputEvent::press(Key::z, false));
  desk_.frames(1);
  EXPECT_TRUE(ImGui::GetIO().KeysDown[static_cast<int>(Key::z)]);
  desk_.frames(1);
  EXPECT_FALSE(ImGui::GetIO().KeysDown[static_cast<int>(Key::z)]);
}

}  // namespace
}  // namespace pedicel::app
