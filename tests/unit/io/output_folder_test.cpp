// A run's folder: what the next run may take away, and what it may not.
#include "engine/io/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "engine/io/atomic_file.h"
#include "engine/io/output_check.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
using testing::UnorderedElementsAre;

void write(const fs::path& file, const std::string& text = "x") {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// What a user sees there: no hidden files.
std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    if (name.find("/.") == std::string::npos && name[0] != '.') names.push_back(name);
  }
  return names;
}

class OutputFolderTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path out_ = folder_ / "out";
};

TEST_F(OutputFolderTest, TheNextRunTakesAwayWhatTheLastOneWroteAndSaysSo) {
  {
    OutputFolder first(out_, {"log.csv"});
    EXPECT_THAT(first.replaced(), IsEmpty());
    write(first.file("log.csv"));
    write(first.file("before_break_1.png"));
    write(first.file("tables/deep/a.csv"));
  }
  OutputFolder second(out_, {"log.csv"});
  EXPECT_THAT(second.replaced(), AllOf(HasSubstr("replaces the run of "), HasSubstr("(3 files)")));
  EXPECT_THAT(names_in(out_), IsEmpty());
}

TEST_F(OutputFolderTest, WhatIsNotOfTheRunStays) {
  write(out_ / "notes.txt", "mine");
  {
    OutputFolder first(out_, {"log.csv"});
    write(first.file("log.csv"));
    write(first.file("run_frames/") / "frame_00001.png");
    write(out_ / "run_frames/mine.txt");
    write(out_ / "later.csv");
  }
  const OutputFolder second(out_, {"log.csv"});
  EXPECT_THAT(names_in(out_),
              UnorderedElementsAre("notes.txt", "run_frames", "run_frames/mine.txt", "later.csv"));
  EXPECT_EQ(read_file(out_ / "notes.txt"), "mine");
}

TEST_F(OutputFolderTest, AFileOfSomebodyElseIsNeverReplaced) {
  write(out_ / "log.csv", "mine");
  EXPECT_THAT([&] { OutputFolder(out_, {"log.csv"}); },
              ThrowsMessage<WriteError>(
                  AllOf(HasSubstr("out/log.csv: is there"), HasSubstr("expected another folder"))));
  OutputFolder folder(out_, {});
  EXPECT_THAT([&] { folder.file("log.csv"); }, ThrowsMessage<WriteError>(HasSubstr("is there")));
  EXPECT_EQ(read_file(out_ / "log.csv"), "mine");
}

TEST_F(OutputFolderTest, WhatCannotBeTakenTakesNothingAway) {
  {
    OutputFolder first(out_, {"log.csv"});
    write(first.file("log.csv"), "earlier");
  }
  write(out_ / "events.csv", "mine");
  EXPECT_THROW(OutputFolder(out_, {"log.csv", "events.csv"}), WriteError);
  EXPECT_EQ(read_file(out_ / "log.csv"), "earlier");
  EXPECT_THROW(check_output_folder(out_, {"events.csv"}), WriteError);
  EXPECT_NO_THROW(check_output_folder(out_, {"log.csv"}));
  EXPECT_EQ(read_file(out_ / "log.csv"), "earlier") << "looking changes nothing";
}

TEST_F(OutputFolderTest, PlacesAreLookedAtBefore) {
  write(folder_ / "file");
  EXPECT_NO_THROW(check_output_file(folder_ / "file"));
  EXPECT_NO_THROW(check_output_file(folder_ / "not/yet/there.csv"));
  EXPECT_NO_THROW(check_output_folder(folder_ / "not/yet"));
  EXPECT_FALSE(fs::exists(folder_ / "not"));
  for (const fs::path& no : {folder_ / "file/x.csv", fs::path(folder_ / "."), fs::path("/dev/null"),
                             fs::path("/proc/x.csv"), folder_ / std::string(300, 'x')})
    EXPECT_THROW(check_output_file(no), WriteError) << no;
  for (const fs::path& no : {folder_ / "file", fs::path("/proc/x")})
    EXPECT_THROW(check_output_folder(no), WriteError) << no;
  const OutputFolder taken(out_, {});
  EXPECT_THAT([&] { check_output_folder(out_); },
              ThrowsMessage<WriteError>(HasSubstr("another run is writing there")));
  EXPECT_THAT(names_in(folder_ / "."), UnorderedElementsAre("file", "out"));
}

TEST_F(OutputFolderTest, AFolderIsLockedByOne) {
  const FolderLock first(folder_ / ".");
  EXPECT_THROW(FolderLock(folder_ / "."), WriteError);
}

TEST_F(OutputFolderTest, WhatCannotBeMovedInStaysBesideIt) {
  std::string said;
  try {
    write_folder(out_, [&](const fs::path& in) {
      write(in / "verdict.json", "hours of work");
      write(out_ / "verdict.json", "mine");  // meanwhile
    });
  } catch (const WriteError& fault) {
    said = fault.what();
  }
  const std::string before = "; what was to go there is in ";
  ASSERT_THAT(said, HasSubstr(before));
  const fs::path kept = said.substr(said.find(before) + before.size());
  EXPECT_EQ(read_file(kept / "verdict.json"), "hours of work");
  EXPECT_EQ(read_file(out_ / "verdict.json"), "mine");
}

TEST_F(OutputFolderTest, ASecondRunAtOnceIsRefused) {
  OutputFolder first(out_, {});
  write(first.file("log.csv"), "first");
  EXPECT_THAT([&] { OutputFolder(out_, {}); },
              ThrowsMessage<WriteError>(HasSubstr("another run is writing there")));
  EXPECT_EQ(read_file(out_ / "log.csv"), "first");
}

// A sweep's runs have folders of their own in its folder.
TEST_F(OutputFolderTest, FoldersOfRunsWithinGoWithTheirOwnLists) {
  {
    OutputFolder whole(out_, {});
    OutputFolder part(whole.file("sweep_a=1/"), {});
    write(part.file("log.csv"));
    write(out_ / "sweep_a=1/mine.txt");
    OutputFolder other(whole.file("sweep_a=2/"), {});
    write(other.file("log.csv"));
  }
  const OutputFolder next(out_, {});
  EXPECT_THAT(names_in(out_), UnorderedElementsAre("sweep_a=1", "sweep_a=1/mine.txt"));
}

TEST_F(OutputFolderTest, PartsOfAKilledRunGoToo) {
  {
    OutputFolder killed(out_, {});
    killed.file("log.csv");
    killed.file("run.mp4");
    write(out_ / "run.mp4.part");
    write(out_ / "log.csv.part1234");
    write(out_ / "log.csv.partly_mine");
  }
  const OutputFolder next(out_, {});
  EXPECT_THAT(names_in(out_), ElementsAre("log.csv.partly_mine"));
}

TEST_F(OutputFolderTest, AListThatPointsElsewhereTakesNothingAway) {
  write(folder_ / "mine.txt");
  write(out_ / ".pedicel-files", "../mine.txt\n" + (folder_ / "mine.txt").string() + "\n");
  const OutputFolder next(out_, {});
  EXPECT_TRUE(fs::exists(folder_ / "mine.txt"));
}

TEST_F(OutputFolderTest, SaysWhyItCannotBeTaken) {
  write(folder_ / "file");
  EXPECT_THAT([&] { OutputFolder(folder_ / "file", {}); },
              ThrowsMessage<WriteError>(HasSubstr("file: cannot be created: Not a directory")));
}

TEST_F(OutputFolderTest, WrittenInOneGoIsWholeOrNotThere) {
  EXPECT_THAT(write_folder(out_, [](const fs::path& in) { write(in / "a/b.csv"); }), IsEmpty());
  EXPECT_THAT(names_in(folder_ / "."), UnorderedElementsAre("out", "out/a", "out/a/b.csv"));
  EXPECT_THROW(write_folder(out_,
                            [](const fs::path& in) {
                              write(in / "c.csv");
                              throw WriteError("full");
                            }),
               WriteError);
  EXPECT_THAT(names_in(folder_ / "."), UnorderedElementsAre("out", "out/a", "out/a/b.csv"));
  EXPECT_THAT(write_folder(out_, [](const fs::path& in) { write(in / "c.csv"); }),
              HasSubstr("replaces the run"));
  EXPECT_THAT(names_in(folder_ / "."), UnorderedElementsAre("out", "out/c.csv"));
}

TEST(NameOfFile, KeepsItsDots) {
  EXPECT_EQ(name_of_file("a/pull_0.1.scene.yaml"), "pull_0.1");
  EXPECT_EQ(name_of_file("pull_0.2.plant.yaml"), "pull_0.2");
  EXPECT_EQ(name_of_file("tree.v2.csv"), "tree.v2");
  EXPECT_EQ(name_of_file("a.b.mtg"), "a.b");
  EXPECT_EQ(name_of_file("pull_0.1"), "pull_0.1");
  EXPECT_EQ(name_of_file(".yaml"), ".yaml");
}

TEST(NameOfFile, IsNeverAFolderAbove) {
  for (const char* name :
       {"..", ".", "a/..", "...scene.yaml", "..scene.yaml", "...yaml", "..csv"}) {
    const fs::path folder = (fs::path("out") / name_of_file(name)).lexically_normal();
    EXPECT_EQ(folder.parent_path(), "out") << name;
    EXPECT_TRUE(folder.has_filename()) << name;
  }
  EXPECT_EQ(name_of_file("...a.scene.yaml"), "...a");
}

}  // namespace
}  // namespace pedicel::io
