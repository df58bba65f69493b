// What a run that is played keeps of its steps, and when its next one is due.
#include "app/session/live/kept_steps.h"

#include <gtest/gtest.h>

#include "app/session/live/run_clock.h"

namespace pedicel::app {
namespace {

std::shared_ptr<const Snapshot> snapshot_of(long step) {
  auto made = std::make_shared<Snapshot>();
  made->step = step;
  return made;
}

KeptSteps steps(long first, long last) {
  KeptSteps kept;
  for (long step = first; step <= last; ++step) kept.add(snapshot_of(step));
  return kept;
}

TEST(KeptSteps, HasWhatWasAdded) {
  const KeptSteps kept = steps(3, 6);
  EXPECT_FALSE(kept.has(2));
  EXPECT_FALSE(kept.has(7));
  for (long step = 3; step <= 6; ++step) {
    ASSERT_TRUE(kept.has(step));
    EXPECT_EQ(kept.at(step).step, step);
  }
  EXPECT_FALSE(KeptSteps().has(0));
}

TEST(KeptSteps, ForgetsTheOldestBeyondItsBound) {
  const KeptSteps kept = steps(0, KeptSteps::most);
  EXPECT_FALSE(kept.has(0));
  EXPECT_TRUE(kept.has(1));
  EXPECT_TRUE(kept.has(KeptSteps::most));
}

TEST(KeptSteps, HasNoGap) {
  KeptSteps kept = steps(3, 6);
  kept.add(snapshot_of(9));
  EXPECT_FALSE(kept.has(6));
  EXPECT_TRUE(kept.has(9));
}

TEST(KeptSteps, DropsWhatBecameAnother) {
  KeptSteps kept = steps(3, 6);
  kept.drop_from(5);
  EXPECT_TRUE(kept.has(4));
  EXPECT_FALSE(kept.has(5));
  kept.drop_from(0);
  EXPECT_TRUE(kept.empty());
}

TEST(RunClock, AStepIsDueBySimulatedTimeAndSpeed) {
  RunClock clock;
  clock.set_speed(2.0);
  clock.start(1.0);
  const auto now = clock.due(1.0);
  const std::chrono::duration<double> later = clock.due(5.0) - now;
  EXPECT_NEAR(later.count(), 2.0, 1e-6);
}

TEST(RunClock, HoldsAtATimeAndNotBefore) {
  RunClock clock;
  EXPECT_FALSE(clock.is_held(5.0));
  clock.hold_at(2.0);
  EXPECT_TRUE(clock.holds());
  EXPECT_FALSE(clock.is_held(1.99));
  EXPECT_TRUE(clock.is_held(2.0 - 1e-12)) << "a sum of steps is rounded";
  clock.hold_at({});
  EXPECT_FALSE(clock.is_held(5.0));
}

// A run that was slow for a while does not rush through what it missed.
TEST(RunClock, LetsGoOfALongDelay) {
  RunClock clock;
  clock.set_speed(1.0);
  clock.start(10.0);
  clock.let_go_of_delay(9.0);  // a second behind
  EXPECT_GT(clock.due(9.0), RunClock::Wall::now() - std::chrono::milliseconds(100));
  clock.start(10.0);
  const auto due = clock.due(12.0);
  clock.let_go_of_delay(12.0);
  EXPECT_EQ(clock.due(12.0), due) << "nothing is behind";
}

}  // namespace
}  // namespace pedicel::app
