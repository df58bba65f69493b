// The task file: what names a case's results, blocks, what is refused.
#include "engine/cluster/task_file.h"

#include "engine/cluster/job_list.h"
#include "engine/cluster/sha256.h"
#include "tests/unit/cluster/cluster_site.h"

namespace pedicel::cluster {
namespace {

using ::testing::HasSubstr;

TEST_F(Site, ShaOfAKnownText) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  io::write_file_atomically("abc.txt", "abc");
  EXPECT_EQ(sha256_of_file("abc.txt"), sha256("abc"));
}

TEST_F(Site, NameOfResultsFollowsWhatTheyAreMadeOf) {
  const TaskFile before = tasks("true", 3);
  EXPECT_NE(before.cases[0].id, before.cases[1].id);
  EXPECT_EQ(tasks("true", 3).cases[1].id, before.cases[1].id);
  EXPECT_NE(tasks("false", 3).cases[1].id, before.cases[1].id);
  io::write_file_atomically("input.txt", "8\n");
  EXPECT_NE(tasks("true", 3).cases[1].id, before.cases[1].id);
  io::write_file_atomically("input.txt", "7\n");
  TaskHead other = before.head;
  other.program.git_hash = "abd";
  EXPECT_NE(case_id(other, before.cases[1]), before.cases[1].id);
  other = before.head;
  other.instruction_set = "OTHER";
  EXPECT_NE(case_id(other, before.cases[1]), before.cases[1].id);
}

TEST_F(Site, ReadsBackWhatItWrites) {
  TaskFile tasks_there = tasks("echo \"a 'b'\" # {}\n", 17);
  make_blocks(tasks_there, 30.0, 7.0);
  EXPECT_EQ(tasks_there.head.blocks, 5);  // of four cases at most
  write_task_file("tasks.jsonl", tasks_there);
  const TaskFile back = read_task_file("tasks.jsonl");
  EXPECT_TRUE(same_cases(back, tasks_there));
  EXPECT_EQ(back.head.run, tasks_there.head.run);
  EXPECT_EQ(back.head.common, tasks_there.head.common);
  std::vector<std::string> ids;
  for (int block = 0; block < 5; ++block) {
    const TaskFile part = read_block("tasks.jsonl", block);
    EXPECT_LE(part.cases.size(), 4u);
    for (const Case& one : part.cases) ids.push_back(one.id);
  }
  ASSERT_EQ(ids.size(), 17u);
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], tasks_there.cases[i].id);
  EXPECT_THROW(read_block("tasks.jsonl", 5), InvalidFile);
}

std::string refusal(const std::string& text) {
  Diagnostics diagnostics;
  parse_task_file(text, "tasks.jsonl", diagnostics);
  return diagnostics.text();
}

TEST_F(Site, RefusesWithLineAndKey) {
  write_task_file("tasks.jsonl", tasks("true", 2));
  const std::string good = io::read_file("tasks.jsonl");
  EXPECT_EQ(refusal(good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal(""), HasSubstr("tasks.jsonl: error: has 0 cases"));
  EXPECT_THAT(refusal("[]\n"), HasSubstr("tasks.jsonl:1:1: error: is no JSON object"));
  EXPECT_THAT(refusal(with("pedicel-tasks", "other")), HasSubstr(":1:1: error: format: expected"));
  EXPECT_THAT(refusal(with("\"version\":1", "\"version\":2")), HasSubstr(":1:1: error: version: "));
  EXPECT_THAT(refusal(with("\"cases\":2", "\"cases\":1e9")), HasSubstr(":1:1: error: cases: "));
  EXPECT_THAT(refusal(with("\"case\":1", "\"case\":0")), HasSubstr(":3:1: error: case: is 0"));
  EXPECT_THAT(refusal(with("\"block\":1", "\"block\":7")), HasSubstr(":3:1: error: block: "));
  EXPECT_THAT(refusal(good.substr(0, good.size() - 30)), HasSubstr(":3:1: error: is no JSON"));
  EXPECT_THAT(refusal(with("\"results\":[0]", "\"results\":[\"x\"]")), HasSubstr("results: "));
}

TEST(Ranges, AreWrittenAsSlurmReadsThem) {
  EXPECT_EQ(ranges_of({}), "");
  EXPECT_EQ(ranges_of({4}), "4");
  EXPECT_EQ(ranges_of({0, 1, 2, 5, 7, 8}), "0-2,5,7-8");
}

}  // namespace
}  // namespace pedicel::cluster
