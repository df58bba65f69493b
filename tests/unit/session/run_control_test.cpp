// The simulation on its own thread: it does what it is told, goes back exactly, and waits for
// nobody.
#include "app/session/live/run_control.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "app/session/live/live_run.h"
#include "app/session/live/organ_place.h"
#include "app/session/live/pull.h"
#include "app/session/session_files.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Running : public ::testing::Test {
 protected:
  Running() : session(waiting()) { draw_plant(session); }

  PullPlace berry() const { return *find_organ(*session.snapshot(), "p/berry", 1.0); }
  std::uint64_t hash() { return session.control().state_hash(); }
  void steps(long count) {
    session.control().step(count);
    session.control().wait();
  }
  void back(long count) {
    session.control().step_back(count);
    session.control().wait();
  }

  Session session;
};

TEST_F(Running, StepsAndTime) {
  steps(24);
  EXPECT_EQ(session.snapshot()->step, 24);
  EXPECT_NEAR(session.snapshot()->time, 0.1, 1.0e-12);
  EXPECT_EQ(session.snapshot()->mode, RunMode::paused);
  must(session.run_text("run 0.4"));
  EXPECT_EQ(session.snapshot()->step, 120);
  must(session.run_text("reset"));
  EXPECT_EQ(session.snapshot()->step, 0);
}

TEST_F(Running, PlaysAtTheSpeedAskedFor) {
  session.control().set_speed(2.0);
  session.control().play();
  const auto start = std::chrono::steady_clock::now();
  while (session.snapshot()->time < 0.5 &&
         std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(wall, 0.2) << "it ran ahead of the clock";
  EXPECT_EQ(session.snapshot()->mode, RunMode::playing);
  session.control().pause();
  session.control().wait();
  const long stopped = session.snapshot()->step;
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_EQ(session.snapshot()->step, stopped);
}

// A look that takes long, or none at all, costs the simulation nothing.
TEST_F(Running, NeverWaitsForThePicture) {
  session.control().set_speed(0.0);
  session.control().play();
  const auto held = session.snapshot();  // held for the whole test
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  const auto after = session.snapshot();
  EXPECT_GT(after->step, held->step);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  const auto last = session.snapshot();
  EXPECT_GT(last->step, after->step + 100);
  EXPECT_GT(last->steps_per_second, 10.0 * std::max(1.0, last->snapshots_per_second));
}

TEST_F(Running, RatesAreThoseOfWhatIsOpen) {
  for (int i = 0; i < 20 && session.snapshot()->steps_per_second == 0.0; ++i) steps(4000);
  EXPECT_GT(session.snapshot()->steps_per_second, 0.0);
  session.files().open_empty();
  EXPECT_EQ(session.snapshot()->steps_per_second, 0.0);
  EXPECT_EQ(session.snapshot()->ms_per_step, 0.0);
}

TEST_F(Running, PullsWithTheForceOfTheSpring) {
  const Vec3 at = session.snapshot()->plants[0].state.position.back();
  PullPlace place = berry();
  place.stiffness = 5.0;
  session.control().begin_pull(place, at + Vec3(0, 0.02, 0));
  steps(480);
  const PullSnapshot pull = session.snapshot()->pull;
  ASSERT_TRUE(pull.active);
  EXPECT_GT(pull.point_W.y(), 0.001);
  EXPECT_NEAR((pull.force_W - 5.0 * (pull.target_W - pull.point_W)).norm(), 0.0, 1.0e-12);
  EXPECT_GT(pull.force_W.y(), 0.0);
  session.control().end_pull();
  steps(960);
  EXPECT_FALSE(session.snapshot()->pull.active);
  EXPECT_LT(std::abs(session.snapshot()->plants[0].state.position.back().y()), 5.0e-4);
}

// Back across a break: the fruit hangs again, bit by bit; forward again it breaks at the same step.
TEST_F(Running, StepsBackAcrossABreak) {
  steps(20);
  const Vec3 far = session.snapshot()->plants[0].state.position.back() + Vec3(0.1, 0, -0.2);
  session.control().begin_pull(berry(), far);
  std::vector<std::uint64_t> hashes;
  long broke = -1;
  for (int i = 0; i < 200 && broke < 0; ++i) {
    hashes.push_back(hash());
    steps(1);
    if (!session.snapshot()->events->empty()) broke = session.snapshot()->step;
  }
  ASSERT_GT(broke, 0) << "the fruit was not pulled off";
  const std::uint64_t broken = hash();
  steps(5);
  back(5);
  EXPECT_EQ(hash(), broken);
  back(1);
  EXPECT_EQ(session.snapshot()->step, broke - 1);
  EXPECT_TRUE(session.snapshot()->events->empty());
  EXPECT_TRUE(session.snapshot()->bodies.empty());
  EXPECT_EQ(hash(), hashes.back());
  steps(1);
  EXPECT_EQ(session.snapshot()->events->size(), 1u);
  EXPECT_EQ(hash(), broken);
}

// Steps that are kept are shown at once, either way, and are the same as those that are run again.
TEST_F(Running, KeptStepsAreWhatTheRunIsThere) {
  session.control().begin_pull(berry(), {0.12, 0.02, 0.15});
  steps(200);
  back(150);  // beyond what is kept: a run from the start
  EXPECT_EQ(session.snapshot()->step, 50);
  for (long step = 49; step > 40; --step) {
    back(1);
    const auto shown = session.snapshot();
    EXPECT_EQ(shown->step, step);
    EXPECT_EQ(shown->mode, RunMode::paused);
  }
  steps(3);
  const auto shown = session.snapshot();
  ASSERT_EQ(shown->step, 44);
  const std::uint64_t hash_there = hash();  // the run has to go there
  const auto run = session.snapshot();
  EXPECT_EQ(run->step, 44);
  EXPECT_EQ(run->plants[0].state.position, shown->plants[0].state.position);
  EXPECT_EQ(run->pull.force_W, shown->pull.force_W);
  steps(20);
  back(20);
  EXPECT_EQ(hash(), hash_there);
  steps(1);
  EXPECT_EQ(session.snapshot()->step, 45);
}

// Back after playing, without a run from the start; what acted meanwhile does not lose the steps
// before it.
TEST_F(Running, PlayedStepsAreShownAtOnce) {
  session.control().set_speed(0.0);
  session.control().play();
  while (session.snapshot()->step < 150) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  session.control().begin_pull(berry(), {0.12, 0.02, 0.15});
  const long acted = session.snapshot()->step;
  while (session.snapshot()->step < acted + 20)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  session.control().pause();
  session.control().wait();
  const long end = session.snapshot()->step;
  const std::uint64_t there = hash();
  const long way = std::min(end - acted + 10, 100l);
  back(way);
  const auto shown = session.snapshot();
  EXPECT_EQ(shown->step, end - way);
  EXPECT_EQ(shown->replay_share, 0.0) << "it was run anew";
  steps(way);
  EXPECT_EQ(session.snapshot()->replay_share, 0.0);
  EXPECT_EQ(hash(), there);
  back(way);
  hash();  // the run has to go there
  EXPECT_EQ(session.snapshot()->plants[0].state.position, shown->plants[0].state.position);
  steps(way);
  EXPECT_EQ(hash(), there);
}

TEST_F(Running, PlayingWaitsWhereItIsHeld) {
  RunControl& control = session.control();
  control.hold_at(0.1);
  control.play();
  control.wait();
  EXPECT_EQ(session.snapshot()->step, 24);
  EXPECT_EQ(session.snapshot()->mode, RunMode::playing);
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  EXPECT_EQ(session.snapshot()->step, 24);
  control.step(100);  // steps are held, too, and go on when they may
  control.hold_at(0.15);
  control.wait();
  EXPECT_EQ(session.snapshot()->step, 36);
  control.hold_at({});
  control.wait();
  EXPECT_EQ(session.snapshot()->step, 124);
  EXPECT_EQ(session.snapshot()->mode, RunMode::paused);
}

TEST_F(Running, WhatIsDoneAfterGoingBackReplacesWhatWasDone) {
  session.control().begin_pull(berry(), {0.3, 0, 0.2});
  steps(40);
  const std::uint64_t pulled = hash();
  back(30);
  session.control().end_pull();
  steps(30);
  EXPECT_NE(hash(), pulled);
  EXPECT_FALSE(session.snapshot()->pull.active);
}

// A pull goes on with the fruit that came off, and does not throw it about.
TEST_F(Running, ThePullGoesOnWithTheFruit) {
  const Vec3 far(0.25, 0, 0.1);
  session.control().begin_pull(berry(), far);
  must(session.run_text("run 2"));
  const auto now = session.snapshot();
  ASSERT_EQ(now->events->size(), 1u);
  ASSERT_EQ(now->bodies.size(), 1u);
  EXPECT_EQ(now->bodies[0].info->plant, 0);
  EXPECT_LT((now->bodies[0].pose.position - far).norm(), 0.03);
}

TEST_F(Running, ABuildThatFailsLeavesTheRunAsItIs) {
  steps(10);
  const std::uint64_t before = hash();
  const Result result = session.run_text("draw stem p loose 1,1,1;1,1,1.2 0.003");
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.text, HasSubstr("loose"));
  EXPECT_EQ(hash(), before);
  must(session.undo());
  steps(1);
}

TEST_F(Running, UnstableRunsAreMarkedAndStayUsable) {
  must(session.run_text("set material p youngs_modulus 1e11"));
  LiveRun broken(session.snapshot()->assets);
  session.control().begin_pull({0, 0, 0.0, 1.0e300}, {1.0e9, 0, 0});
  steps(2000);
  const auto now = session.snapshot();
  ASSERT_EQ(now->mode, RunMode::unstable) << "at " << now->time;
  EXPECT_THAT(now->error, HasSubstr("unstable at"));
  EXPECT_LT(now->last_good_time, now->time);
  steps(5);
  EXPECT_EQ(session.snapshot()->step, now->step) << "an unstable run goes on";
  must(session.run_text("reset"));
  EXPECT_EQ(session.snapshot()->mode, RunMode::paused);
  steps(5);
  EXPECT_EQ(session.snapshot()->step, 5);
}

// A report is of its step alone, however many there were before.
TEST_F(Running, ReportsDoNotAddUp) {
  const auto last = [&](const char* name) {
    return session.control().log().series(name).value.back();
  };
  must(session.run_text("run 0.5"));
  const double energy =
      last("energy_kinetic_J") + last("energy_elastic_J") + last("energy_gravity_J");
  EXPECT_NEAR(session.snapshot()->report.plant_energy, energy, 1e-2 * std::abs(energy));
}

TEST_F(Running, QuantitiesAreKept) {
  session.control().log().watch("p/branch");
  must(session.run_text("run 0.5"));
  const RunLog& log = session.control().log();
  const auto series = log.series("energy_gravity_J");
  ASSERT_GT(series.time.size(), 45u);
  EXPECT_NEAR(series.time.back(), 0.5, 0.011);
  EXPECT_TRUE(log.series("no such thing").time.empty());
  const std::vector<OrganLoad> loads = log.loads();
  ASSERT_GT(loads.size(), 45u);
  // The berry's weight, and a little of the branch's, hangs on the branch's foot.
  const double weight = 9.81 * 950.0 * 4.0 / 3.0 * 3.14159265 * 1.0e-6;
  EXPECT_GT(loads.back().force, weight);
  EXPECT_LT(loads.back().force, 1.5 * weight);
  EXPECT_GT(loads.back().moment, 0.09 * weight);
}

}  // namespace
}  // namespace pedicel::app
