// Cases and their results: whole or not there, done once, refused as a mixture.
#include <fstream>

#include "tests/unit/cluster/cluster_site.h"

namespace pedicel::cluster {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string writes_number = "cat input.txt > \"$1/number.txt\"; echo $3 >> \"$1/number.txt\"";

CaseRecord done(const TaskFile& tasks, int number, const fs::path& scratch = {}) {
  InputCheck inputs(tasks.head);
  return run_case(tasks.head, tasks.cases[number], inputs,
                  {RunFolder(fs::absolute("run")), scratch, "SET"});
}

TEST_F(Site, ACaseLeavesItsResultsAndItsRecord) {
  const TaskFile made = tasks(writes_number, 2);
  const CaseRecord record = done(made, 1);
  EXPECT_EQ(record.reason, "");
  EXPECT_EQ(record.instruction_set, "SET");
  EXPECT_EQ(record.program.version, "1.2.3");
  EXPECT_EQ(record.restarts, 0);
  const RunFolder folder("run");
  const fs::path result = folder.result(made.cases[1].id);
  EXPECT_THAT(io::read_file(result / "out" / "number.txt"), HasSubstr("7\n1\n"));
  EXPECT_EQ(finished(folder, made.cases[1].id)->host, record.host);
  EXPECT_FALSE(finished(folder, made.cases[0].id));
  EXPECT_TRUE(fs::is_empty("run/parts"));
}

TEST_F(Site, WhatIsThereIsNotDoneAgain) {
  const TaskFile made = tasks("echo x >> count.txt", 1);
  done(made, 0);
  done(made, 0);
  EXPECT_EQ(io::read_file("count.txt"), "x\n");
}

TEST_F(Site, ScratchIsLeftEmpty) {
  const TaskFile made = tasks(writes_number, 1);
  EXPECT_EQ(done(made, 0, folder_ / "scratch").reason, "");
  EXPECT_TRUE(fs::is_empty("scratch"));
  EXPECT_TRUE(fs::exists(RunFolder("run").result(made.cases[0].id) / "out" / "number.txt"));
}

TEST_F(Site, AFailureSaysWhyAndLeavesNothingElse) {
  const TaskFile made = tasks("echo half > \"$1/half.txt\"; echo no room >&2; exit 6", 1);
  const CaseRecord record = done(made, 0);
  EXPECT_EQ(record.exit_code, 6);
  EXPECT_EQ(record.reason, "no room");
  const RunFolder folder("run");
  EXPECT_FALSE(fs::exists(folder.result(made.cases[0].id)));
  EXPECT_TRUE(fs::is_empty("run/parts"));
  EXPECT_EQ(parse_record(io::read_file(folder.failure(made.cases[0].id)), "").reason, "no room");
}

TEST_F(Site, ASignalIsToldByName) {
  const TaskFile made = tasks("kill -9 $$", 1);
  EXPECT_THAT(done(made, 0).reason, HasSubstr("signal 9 (Killed)"));
}

TEST_F(Site, AChangedInputIsFound) {
  const TaskFile made = tasks("true", 2);
  InputCheck inputs(made.head);
  EXPECT_EQ(inputs.fault(), "");
  io::write_file_atomically("input.txt", "other\n");
  EXPECT_THAT(inputs.fault(), HasSubstr("input.txt: is not what it was"));
  EXPECT_THAT(done(made, 0).reason, HasSubstr("input.txt: is not what it was"));
  fs::remove("input.txt");
  EXPECT_THAT(inputs.fault(), HasSubstr("input.txt: cannot be read"));
}

TEST_F(Site, ASurveyTellsWhatIsMissing) {
  TaskFile made = tasks("exit $3", 4);
  make_blocks(made, 2.0, 1.0);
  ASSERT_EQ(made.head.blocks, 2);
  for (int i = 0; i < 3; ++i) done(made, i);
  Surveyor surveyor(RunFolder("run"), made);
  const Survey survey = surveyor.look(true);
  EXPECT_THAT(survey.missing, ::testing::ElementsAre(1, 2, 3));
  EXPECT_EQ(survey.failures.size(), 2u);
  EXPECT_THAT(missing_blocks(survey, made), ::testing::ElementsAre(0, 1));
}

TEST_F(Site, AMixtureIsRefused) {
  const TaskFile made = tasks("true", 2);
  done(made, 0);
  CaseRecord other = done(made, 1);
  Surveyor before(RunFolder("run"), made);
  EXPECT_EQ(mixture(before.look(true)), "");
  other.instruction_set = "OTHER";
  other.host = "node7";
  io::write_file_atomically(RunFolder("run").result(made.cases[1].id) / "record.json",
                            to_json(other));
  Surveyor after(RunFolder("run"), made);
  const std::string fault = mixture(after.look(true));
  EXPECT_THAT(fault, HasSubstr("case 1 of node7 has instruction set OTHER"));
  EXPECT_THAT(fault, HasSubstr("--instruction-set"));
}

TEST_F(Site, AnotherShellIsTold) {
  const ClusterOptions options{};
  const Campaign first("run", plan("true", 1), options, about());
  EXPECT_THROW(Campaign("run", plan("true", 1), options, about()), UsageError);
}

}  // namespace
}  // namespace pedicel::cluster
