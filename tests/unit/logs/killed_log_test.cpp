// A program that is killed leaves a log that can be read.
#include "plugins/discrepancy/log_import/log_contents.h"
#include "tests/unit/app/program_case.h"

namespace pedicel {
namespace {

TEST_F(Program, LeavesAReadableLogWhenKilled) {
  const pid_t child = start({"--headless", path("quick.scene.yaml"), "--duration", "1000", "--out",
                             path("out"), "--no-pictures", "--log", path("run.mcap")});
  ASSERT_TRUE(wait_for("run.mcap", 40000));
  ::kill(child, SIGKILL);
  EXPECT_EQ(exit_code_of(child), -1);
  const discrepancy::LogContents log = discrepancy::read_log(path("run.mcap"));
  EXPECT_FALSE(log.whole);
  ASSERT_TRUE(log.topic("/clock"));
  EXPECT_GT(log.topic("/clock")->messages, 50U);
  double last = -1.0;
  for (const auto& one : log.frames.at("stem/stem")) {
    EXPECT_GT(one.stamp, last);
    last = one.stamp;
  }
}

TEST_F(Program, EndsItsLogWhenStopped) {
  const pid_t child = start({"--headless", path("quick.scene.yaml"), "--duration", "1000", "--out",
                             path("out"), "--no-pictures", "--log", path("run.mcap")});
  ASSERT_TRUE(wait_for("run.mcap", 40000));
  ::kill(child, SIGINT);
  EXPECT_EQ(exit_code_of(child), 130);
  EXPECT_TRUE(discrepancy::read_log(path("run.mcap")).whole);
}

TEST_F(Program, RefusesALogThatCannotBeWritten) {
  write("file", "");
  EXPECT_EQ(run_scene("--log " + path("file/run.mcap")), 6);
  EXPECT_THAT(err_, ::testing::HasSubstr("cannot be written"));
}

}  // namespace
}  // namespace pedicel
