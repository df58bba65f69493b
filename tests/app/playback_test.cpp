// The window that plays a log, by real input events.
#include <gtest/gtest.h>

#include <cstdlib>

#include "app/window/playback_window.h"
#include "tests/unit/logs/logged_run.h"

namespace pedicel::app {
namespace {

class Playback : public ::testing::Test {
 protected:
  void key(Key key) {
    platform_->send(InputEvent::press(key, true));
    frames(1);
    platform_->send(InputEvent::press(key, false));
    frames(1);
  }
  void frames(int count) {
    for (int i = 0; i < count; ++i) open_ = window_->frame();
  }
  void open(std::unique_ptr<ScriptedPlatform> platform) {
    platform_ = std::move(platform);
    window_ = std::make_unique<PlaybackWindow>(*platform_, film_);
  }
  LoggedRun run_{"0.03", 1.0};
  LogFilm film_{run_.log_file(), {}};
  std::unique_ptr<ScriptedPlatform> platform_;
  std::unique_ptr<PlaybackWindow> window_;
  bool open_ = true;
};

TEST_F(Playback, PlaysAtTheLogsPaceAndStopsAtItsEnd) {
  open(open_null({}));
  frames(31);
  EXPECT_NEAR(window_->time(), 0.5, 0.04) << "30 pictures of 1/60 s";
  frames(60);
  EXPECT_EQ(window_->time(), film_.end());
  EXPECT_FALSE(window_->playing());
  key(Key::space);
  frames(2);
  EXPECT_LT(window_->time(), 0.2) << "from the beginning again";
}

TEST_F(Playback, KeysLeadIt) {
  open(open_null({}));
  frames(2);
  key(Key::space);
  EXPECT_FALSE(window_->playing());
  const double still = window_->time();
  frames(5);
  EXPECT_EQ(window_->time(), still);
  key(Key::right);
  EXPECT_NEAR(window_->time(), still + 1.0 / 30.0, 1e-9);
  key(Key::left);
  EXPECT_NEAR(window_->time(), still, 1e-9);
  key(Key::end);
  EXPECT_EQ(window_->time(), film_.end());
  key(Key::home);
  EXPECT_EQ(window_->time(), film_.begin());
  EXPECT_TRUE(open_);
  platform_->send(InputEvent::press(Key::left_control, true));
  platform_->send(InputEvent::press(Key::q, true));
  frames(2);
  EXPECT_FALSE(open_);
}

TEST_F(Playback, ShowsWhatMoves) {
  std::string why;
  PlatformOptions options;
  options.size = {320, 240};
  auto platform = open_offscreen(options, why);
  if (!platform) GTEST_SKIP() << why;
  open(std::move(platform));
  frames(2);
  key(Key::space);
  key(Key::home);
  frames(3);
  const auto first = window_->window().picture();
  key(Key::end);
  frames(3);
  const auto last = window_->window().picture();
  ASSERT_TRUE(first && last);
  long changed = 0;
  // Of the scene, above the time line.
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 320; ++x)
      for (int i = 0; i < 3; ++i)
        changed += std::abs(int{first->at(x, y)[i]} - int{last->at(x, y)[i]}) > 20;
  EXPECT_GT(changed, 50);
}

}  // namespace
}  // namespace pedicel::app
