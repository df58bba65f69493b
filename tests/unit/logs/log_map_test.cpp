// The words with which a map is refused.
#include "plugins/discrepancy/log_import/log_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pedicel::discrepancy {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& more,
                    const std::string& head =
                        "format: pedicel-log-map\nversion: 1\nscene: s.yaml\n"
                        "joints: {topic: /joint_states}\n") {
  Diagnostics diagnostics;
  const auto map = parse_log_map(head + more, "map.yaml", diagnostics);
  EXPECT_EQ(static_cast<bool>(map), !diagnostics.has_errors());
  return diagnostics.text();
}

TEST(LogMap, AGoodOneIsRead) {
  EXPECT_EQ(refusal(""), "");
  EXPECT_EQ(refusal("clock: log\nfollows: commands\ncommands: {topic: /c}\n"), "");
}

TEST(LogMap, WrongOnesAreRefused) {
  EXPECT_THAT(refusal("", "format: pedicel-log-map\nversion: 2\n"), HasSubstr("version"));
  EXPECT_THAT(refusal("", "format: pedicel-log-map\nversion: 1\n"),
              HasSubstr("map.yaml:1:1: error: missing key \"scene\""));
  EXPECT_THAT(refusal("topics: 1\n"), HasSubstr("map.yaml:5:1: error: unknown key \"topics\""));
  EXPECT_THAT(refusal("clock: wall\n"), HasSubstr("expected"));
  EXPECT_THAT(refusal("follows: commands\n"), HasSubstr("expected commands with their topic"));
  EXPECT_THAT(refusal("markers: [{name: a, curve: c, at: 1}]\n"),
              HasSubstr("expected one of frame and topic"));
  EXPECT_THAT(refusal("markers: [{name: a, frame: f, topic: t, curve: c, at: 1}]\n"),
              HasSubstr("expected one of frame and topic"));
  EXPECT_THAT(refusal("markers: [{name: a, frame: f, curve: c, at: 2}]\n"), HasSubstr("at"));
  EXPECT_THAT(refusal("markers: [{name: a/b, frame: f, curve: c, at: 1}]\n"),
              HasSubstr("name \"a/b\", expected one without / \\ , and quotes"));
  EXPECT_THAT(refusal("markers: [{name: a, frame: f, curve: c, at: 1}, {name: a, frame: g, curve: "
                      "c, at: 1}]\n"),
              HasSubstr("\"a\" appears twice"));
  EXPECT_THAT(refusal("trials: [{name: .., from: 1}]\n"), HasSubstr("name \"..\""));
  EXPECT_THAT(refusal("trials: [{name: a, from: 2, to: 1}]\n"),
              HasSubstr("to: expected a time after from"));
  EXPECT_THAT(refusal("wrenches: [{name: w, topic: /w}]\n"), HasSubstr("missing key \"link\""));
}

}  // namespace
}  // namespace pedicel::discrepancy
