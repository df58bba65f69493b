// Parameters of a running plant: what only changes constants goes on, the rest starts anew, and
// both are exact.
#include <gmock/gmock.h>

#include "app/session/session_tuning.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Tuning : public ::testing::Test {
 protected:
  Tuning() : session(waiting()) {
    draw_plant(session);
    must(session.run_text("run 0.2"));
  }
  long step() const { return session.snapshot()->step; }
  const SessionParameter& parameter(const std::string& key) {
    all = session.tuning().parameters();
    for (const SessionParameter& one : all)
      if (one.key == key) return one;
    ADD_FAILURE() << "no parameter " << key;
    return all.front();
  }

  Session session;
  std::vector<SessionParameter> all;
};

TEST_F(Tuning, AStifferPlantGoesOnWithoutARestart) {
  const double before = session.snapshot()->plants[0].model->elements[0].bend_stiffness[0];
  must(session.run_text("set plants.p.material.youngs_modulus 4e8"));
  EXPECT_EQ(step(), 48);
  EXPECT_NEAR(session.snapshot()->plants[0].model->elements[0].bend_stiffness[0] / before, 2.0,
              1.0e-9);
  must(session.run_text("step 5"));
  EXPECT_EQ(step(), 53);
  must(session.run_text("undo"));
  EXPECT_EQ(step(), 53);
  EXPECT_NEAR(session.snapshot()->plants[0].model->elements[0].bend_stiffness[0] / before, 1.0,
              1.0e-9);
}

// A leaf's ring of veins is closed by welds, which are drawn open by what they carry.
TEST_F(Tuning, APlantWithLeavesGoesOnToo) {
  must(session.run_text("add leaf p leaf stem 0.8 0.06"));
  must(session.run_text("run 0.2"));
  const long before = step();
  ASSERT_FALSE(session.snapshot()->plants[0].model->welds.empty());
  must(session.run_text("set plants.p.material.youngs_modulus 4e8"));
  EXPECT_EQ(step(), before);
  must(session.run_text("set plants.p.material.poisson_ratio 0.2"));
  EXPECT_EQ(step(), before);
  must(session.run_text("set plants.p.material.density 600"));
  EXPECT_EQ(step(), before);
  must(session.run_text("move point p branch 2 0.1,0,0.151"));
  EXPECT_EQ(step(), 0) << "another shape";
}

// A slider begins at the number that it shows: that one is no change, whatever stems have of their
// own.
TEST_F(Tuning, TheNumberShownChangesNothing) {
  must(session.run_text("set material p youngs_modulus 2e7 stem=branch"));
  must(session.run_text("set material p density 500 stem=branch"));
  must(session.run_text("run 0.1"));
  const cosserat::RodModel before = *session.snapshot()->plants[0].model;
  for (const char* name : {"youngs_modulus", "density", "poisson_ratio", "damping_time"}) {
    const std::string key = std::string("plants.p.material.") + name;
    must(session.run(
        Command("set", {{"key", key}, {"value", std::to_string(parameter(key).value)}})));
  }
  const cosserat::RodModel& now = *session.snapshot()->plants[0].model;
  ASSERT_EQ(now.size(), before.size());
  for (int e = 0; e < now.size(); ++e) {
    EXPECT_EQ(now.elements[e].bend_stiffness, before.elements[e].bend_stiffness) << e;
    EXPECT_EQ(now.elements[e].mass, before.elements[e].mass) << e;
  }
}

// The change is really felt: a pulled branch gives way half as far when it is twice as stiff. (It
// stands as drawn under its own weight either way.)
TEST_F(Tuning, TheChangeIsFelt) {
  const auto given_way = [&] {
    const Vec3 drawn = session.snapshot()->plants[0].model->elements.back().drawn_position;
    must(session.run_text("pull p/branch 0.1,0.002,0.15 stiffness=1"));
    must(session.run_text("run 3"));
    const Vec3 now = session.snapshot()->plants[0].state.position.back();
    must(session.run_text("release"));
    must(session.run_text("run 3"));
    return (now - drawn).norm();
  };
  const double soft = given_way();
  must(session.run_text("set plants.p.material.youngs_modulus 2e9"));
  const double stiff = given_way();
  EXPECT_GT(soft, 3.0 * stiff);
}

TEST_F(Tuning, AStepBackGoesThroughTheChange) {
  must(session.run_text("pull p/branch 0.1,0.02,0.15 stiffness=5"));
  must(session.run_text("run 0.1"));
  must(session.run_text("set plants.p.material.youngs_modulus 4e8"));
  must(session.run_text("set rods.newton_iterations 2"));
  must(session.run_text("set coupling.friction 0.9"));
  must(session.run_text("run 0.1"));
  const std::uint64_t hash = session.control().state_hash();
  must(session.run_text("run 0.05"));
  must(session.run_text("step back 12"));
  EXPECT_EQ(session.control().state_hash(), hash);
}

TEST_F(Tuning, AnotherShapeStartsAnew) {
  must(session.run_text("set plants.p.sampling.distance 0.01"));
  EXPECT_EQ(step(), 0);
}

TEST_F(Tuning, ParametersAreDescribedAndReset) {
  EXPECT_EQ(parameter("rods.newton_iterations").value, 4.0);
  EXPECT_TRUE(parameter("rods.newton_iterations").whole);
  EXPECT_EQ(parameter("plants.p.material.youngs_modulus").unit, "Pa");
  EXPECT_EQ(parameter("plants.p.detach.bend").value, 0.5);
  must(session.run_text("set plants.p.detach.bend 0.7"));
  EXPECT_EQ(parameter("plants.p.detach.bend").value, 0.7);
  EXPECT_EQ(parameter("plants.p.detach.bend").initial, 0.5);
  EXPECT_TRUE(parameter("plants.p.detach.bend").changed);
  must(session.tuning().reset("plants.p.detach.bend"));
  EXPECT_EQ(parameter("plants.p.detach.bend").value, 0.5);
}

TEST_F(Tuning, WhatCannotBeIsRefused) {
  EXPECT_THAT(session.run_text("set rods.newton_iterations 0").text,
              HasSubstr("must be between 1 and 1000"));
  EXPECT_THAT(session.run_text("set rods.speed 3").text, HasSubstr("unknown key \"speed\""));
  EXPECT_THAT(session.run_text("set plants.q.material.density 3").text,
              HasSubstr("no plant of that name"));
  EXPECT_THAT(session.run_text("set material.density -3").text, HasSubstr("material.density"));
  EXPECT_TRUE(session.document().settings.empty());
}

TEST_F(Tuning, KeptParametersGoIntoThePlant) {
  must(session.run_text("set plants.p.material.density 600"));
  must(session.run_text("set rods.newton_iterations 5"));
  must(session.run_text("keep"));
  EXPECT_EQ(session.document().plant("p").material.density, 600.0);
  ASSERT_EQ(session.document().settings.size(), 1u);
  EXPECT_EQ(session.document().settings[0].first, "rods.newton_iterations");
  must(session.undo());
  EXPECT_EQ(session.document().plant("p").material.density, 800.0);
  EXPECT_EQ(session.document().settings.size(), 2u);
  must(session.run_text("discard"));
  EXPECT_TRUE(session.document().settings.empty());
}

TEST_F(Tuning, ASliderDragIsOneStep) {
  const std::size_t before = session.history().size();
  session.begin_gesture();
  for (const char* value : {"700", "650", "600"})
    must(session.run_text(std::string("set plants.p.material.density ") + value));
  session.end_gesture();
  EXPECT_EQ(session.history().size(), before + 1);
  EXPECT_EQ(session.log().back(), "set plants.p.material.density 600");
  must(session.undo());
  EXPECT_TRUE(session.document().settings.empty());
}

}  // namespace
}  // namespace pedicel::app
