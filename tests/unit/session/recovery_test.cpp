// What a killed program leaves: a child process draws, is killed with SIGKILL, and the next session
// finds everything that was done, but for the gesture in hand.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>

#include "app/session/journal.h"
#include "app/session/session_files.h"
#include "app/session/session_recovery.h"
#include "engine/io/atomic_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

SessionOptions saving(const TemporaryFolder& folder) {
  SessionOptions options = waiting();
  options.autosave = folder / "autosave";
  return options;
}

/// Runs `work` in a child with a session, until it has said its hash; then kills the child with -9.
std::uint64_t killed_after(const SessionOptions& options,
                           const std::function<void(Session&)>& work) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    Session session(options);
    work(session);
    const std::uint64_t hash = session.document().state_hash();
    if (write(ends[1], &hash, sizeof hash) < 0) _exit(1);
    pause();
    _exit(0);
  }
  std::uint64_t hash = 0;
  EXPECT_EQ(read(ends[0], &hash, sizeof hash), static_cast<ssize_t>(sizeof hash));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  close(ends[0]);
  close(ends[1]);
  return hash;
}

void recover_the_one(Session& session) {
  ASSERT_EQ(session.recovery().lost_documents().size(), 1u);
  ASSERT_TRUE(session.recovery().recover(session.recovery().lost_documents()[0]));
}

TEST(Recovery, AKilledSessionLosesNothingThatWasDone) {
  TemporaryFolder folder;
  const std::uint64_t lost_hash = killed_after(saving(folder), [](Session& session) {
    draw_plant(session);
    must(session.run_text("move point p branch 2 0.12,0,0.14"));
    must(session.run_text("set coupling.friction 0.7"));
    must(session.run_text("delete stem p branch"));
    must(session.undo());
  });
  Session session(saving(folder));
  const auto lost = session.recovery().lost_documents();
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].commands, 8);
  EXPECT_NE(session.document().state_hash(), lost_hash);
  ASSERT_TRUE(session.recovery().recover(lost[0]));
  EXPECT_EQ(session.document().state_hash(), lost_hash);
  EXPECT_TRUE(session.files().dirty());
  EXPECT_TRUE(session.recovery().lost_documents().empty());
  must(session.redo());  // the history came back, too
  EXPECT_EQ(session.document().plant("p").curves.size(), 1u);
}

TEST(Recovery, OnlyTheGestureInHandIsLost) {
  TemporaryFolder folder;
  killed_after(saving(folder), [](Session& session) {
    draw_plant(session);
    session.begin_gesture();
    must(session.run_text("move point p branch 2 0.2,0,0.1"));
  });
  Session session(saving(folder));
  recover_the_one(session);
  const plant::PlantFile& plant = session.document().plant("p");
  ASSERT_EQ(plant.curves.size(), 2u);
  EXPECT_EQ(plant.fruits.size(), 1u);
  EXPECT_EQ(plant.curves[1].points[2], Vec3(0.1, 0, 0.15));
}

TEST(Recovery, EditsOfAFileComeBackOverTheFile) {
  TemporaryFolder folder;
  const auto file = folder / "tomato.plant.yaml";
  std::filesystem::copy_file(source("plants/cherry_tomato.plant.yaml"), file);
  const std::uint64_t lost_hash = killed_after(saving(folder), [&](Session& session) {
    ASSERT_TRUE(session.files().open(file));
    must(session.run_text("set radius \"cherry tomato\" truss 0.004"));
    must(session.files().save());
    must(session.run_text("set length \"cherry tomato\" stalk_5 0.05"));
  });
  Session session(saving(folder));
  const auto lost = session.recovery().lost_documents();
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].document, file);
  EXPECT_EQ(lost[0].commands, 1);  // what was saved is in the file
  ASSERT_TRUE(session.recovery().recover(lost[0]));
  EXPECT_EQ(session.document().state_hash(), lost_hash);
  EXPECT_TRUE(session.files().dirty());
}

TEST(Recovery, ARunningOrWellEndedSessionIsNotLost) {
  TemporaryFolder folder;
  {
    Session first(saving(folder));
    draw_plant(first);
    Session second(saving(folder));
    EXPECT_TRUE(second.recovery().lost_documents().empty()) << "the first one is alive";
    first.files().give_up_edits();
  }
  EXPECT_TRUE(Session(saving(folder)).recovery().lost_documents().empty());
}

// A terminal's Ctrl-C, a desktop that ends: nobody was asked.
TEST(Recovery, WhatWasNeitherSavedNorGivenUpIsKept) {
  TemporaryFolder folder;
  {
    Session session(saving(folder));
    draw_plant(session);
    session.begin_gesture();
    must(session.run_text("move point p branch 2 0.2,0,0.1"));
  }
  Session session(saving(folder));
  recover_the_one(session);
  EXPECT_EQ(session.document().plant("p").curves[1].points[2], Vec3(0.2, 0, 0.1));
  must(session.files().save(folder / "p.plant.yaml"));
  EXPECT_FALSE(session.files().dirty());
}

TEST(Recovery, AFolderThatCannotBeWrittenIsSaid) {
  TemporaryFolder folder;
  std::ofstream(folder / "autosave") << "a file";
  Session session(saving(folder));
  ASSERT_EQ(session.messages().all().size(), 1u);
  EXPECT_THAT(session.messages().all()[0].text, HasSubstr("autosave is off"));
  draw_plant(session);
}

TEST(Recovery, HalfALineIsLeftOut) {
  TemporaryFolder folder;
  const auto file = folder / "x.journal";
  std::ofstream(file) << "# pedicel journal 1\n# document \n# base\nnew plant p #0000000000000001\n"
                         "draw stem p s 0,0,0;0,0,0.";
  const JournalContent content = read_journal(file);
  ASSERT_EQ(content.commands.size(), 1u);
  EXPECT_EQ(content.commands[0].command, "new plant p");
  EXPECT_EQ(content.commands[0].hash, 1u);
  std::ofstream(file) << "something else\n";
  EXPECT_THROW(read_journal(file), InvalidFile);
}

}  // namespace
}  // namespace pedicel::app
