// Strings that hold plants, as commands: added, changed, taken away, undone and saved.
#include <gmock/gmock.h>

#include "app/session/session_files.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/edit_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

class Tying : public ::testing::Test {
 protected:
  Tying() : session(waiting()) {
    for (const char* line : draw_lines) run(line);
  }
  void run(const std::string& line) { must(session.run_text(line)); }
  std::string refusal(const std::string& line) {
    const std::uint64_t before = session.document().state_hash();
    const Result result = session.run_text(line);
    EXPECT_FALSE(result.ok) << line;
    EXPECT_EQ(session.document().state_hash(), before) << line;
    return result.text;
  }
  const std::vector<world::SceneTie>& ties() const { return session.document().scene->ties; }

  TemporaryFolder folder;
  Session session;
};

TEST_F(Tying, AStringIsAddedChangedAndTakenAway) {
  run("add tie p/stem to=0.3,0,0.4 at=0.5");
  run("add tie p/stem offset=0,0.2,0 length=0.25 stiffness=50");
  ASSERT_EQ(ties().size(), 2u);
  EXPECT_EQ(ties()[0].organ, "p/stem");
  EXPECT_EQ(ties()[0].to, Vec3(0.3, 0, 0.4));
  EXPECT_FALSE(ties()[0].length.has_value());
  EXPECT_TRUE(ties()[1].is_offset);
  run("set tie 1 length 0.1");
  run("set tie 1 stiffness 20");
  run("set tie 1 at 0.75");
  run("move tie 1 offset=0,0,0.3");
  EXPECT_EQ(ties()[0].length.value(), 0.1);
  EXPECT_EQ(ties()[0].stiffness, 20.0);
  EXPECT_EQ(ties()[0].at, 0.75);
  EXPECT_TRUE(ties()[0].is_offset);
  run("tauten tie 1");
  EXPECT_FALSE(ties()[0].length.has_value());
  run("delete tie 1");
  ASSERT_EQ(ties().size(), 1u);
  EXPECT_EQ(ties()[0].stiffness, 50.0);
  for (int i = 0; i < 7; ++i) must(session.undo());
  EXPECT_EQ(ties().size(), 1u);
  EXPECT_EQ(ties()[0].at, 0.5);
  EXPECT_EQ(ties()[0].stiffness, world::SceneTie{}.stiffness);
}

// It holds what hangs, in the running simulation, and says how it runs.
TEST_F(Tying, TheRunningPlantIsHeld) {
  run("add tie p/stem to=0.3,0,0.4 length=0.05 stiffness=5");
  session.control().wait();
  run("step 240");
  const auto now = session.snapshot();
  ASSERT_EQ(now->ties.size(), 1u);
  EXPECT_EQ(now->ties[0].number, 0);
  EXPECT_EQ(now->ties[0].course.to_W, Vec3(0.3, 0, 0.4));
  EXPECT_GT(now->ties[0].course.tension, 0.1);
  const double stretch =
      (now->ties[0].course.to_W - now->ties[0].course.from_W).norm() - now->ties[0].course.length;
  EXPECT_NEAR(now->ties[0].course.tension, 5.0 * stretch, 1e-9);
}

TEST_F(Tying, AStringEndsOnAStem) {
  run("new plant q");
  run("draw stem q wire -0.2,0,0.3;0,0,0.3;0.2,0,0.3 0.002");
  run("add tie p/branch to_organ=q/wire");
  run("add tie p/berry to_organ=p/stem to_at=0.9");
  ASSERT_EQ(ties().size(), 2u);
  EXPECT_EQ(ties()[0].to_organ, "q/wire");
  EXPECT_FALSE(ties()[0].to_at.has_value());
  run("set tie 1 to_at 0.25");
  EXPECT_EQ(ties()[0].to_at.value(), 0.25);
  run("rename q wire cable");
  EXPECT_EQ(ties()[0].to_organ, "q/cable");
  EXPECT_THAT(refusal("delete plant q"), HasSubstr("1 tie"));
  must(session.files().save(folder / "wired.scene.yaml"));
  Session again(waiting());
  ASSERT_TRUE(again.files().open(folder / "wired.scene.yaml"));
  EXPECT_EQ(again.document().scene->ties[0].to_organ, "q/cable");
  EXPECT_EQ(again.document().scene->ties[0].to_at.value(), 0.25);
  EXPECT_EQ(again.document().scene->ties[1].to_organ, "p/stem");
  run("move tie 1 to=0,0,1");
  EXPECT_TRUE(ties()[0].to_organ.empty());
  EXPECT_FALSE(ties()[0].to_at.has_value());
  EXPECT_THAT(refusal("set tie 1 to_at 0.5"), HasSubstr("ends at a point"));
}

TEST_F(Tying, WhatCannotBeIsRefused) {
  EXPECT_THAT(refusal("add tie p/bough to=0,0,1"), HasSubstr("no organ \"p/bough\""));
  EXPECT_THAT(refusal("add tie p/stem"), HasSubstr("expected to, offset or to_organ"));
  EXPECT_THAT(refusal("add tie p/stem to=0,0,1 offset=0,0,1"),
              HasSubstr("expected one of to, offset and to_organ"));
  EXPECT_THAT(refusal("add tie p/stem to=0,0,1 at=1.5"), HasSubstr("between 0 and 1"));
  EXPECT_THAT(refusal("add tie p/stem to=0,0,1 stiffness=0"),
              HasSubstr("stiffness 0, expected a number between 0.001"));
  EXPECT_THAT(refusal("set tie 1 at 0.5"), HasSubstr("one to be added before"));
  run("add tie p/stem to=0,0,1");
  EXPECT_THAT(refusal("set tie 2 at 0.5"), HasSubstr("from 1 to 1"));
  EXPECT_THAT(refusal("set tie 1 colour 2"), HasSubstr("at, to_at, length, stiffness"));
  EXPECT_THAT(refusal("set tie 1 length -1"), HasSubstr("length -1, expected a number >= 0"));
  EXPECT_THAT(refusal("move tie 1"), HasSubstr("nothing to move"));
}

TEST_F(Tying, AreSavedAndReadAgain) {
  run("add tie p/stem to=0.3,0,0.4 at=0.5 length=0.3 stiffness=75");
  must(session.files().save(folder / "tied.scene.yaml"));
  Session again(waiting());
  ASSERT_TRUE(again.files().open(folder / "tied.scene.yaml"));
  ASSERT_EQ(again.document().scene->ties.size(), 1u);
  const world::SceneTie& tie = again.document().scene->ties[0];
  EXPECT_EQ(tie.organ, "p/stem");
  EXPECT_EQ(tie.at, 0.5);
  EXPECT_EQ(tie.to, Vec3(0.3, 0, 0.4));
  EXPECT_EQ(tie.length.value(), 0.3);
  EXPECT_EQ(tie.stiffness, 75.0);
  must(again.run_text("delete tie 1"));
  must(again.files().save());
  EXPECT_THAT(io::read_file(folder / "tied.scene.yaml"), ::testing::Not(HasSubstr("p/stem")));
}

}  // namespace
}  // namespace pedicel::app
