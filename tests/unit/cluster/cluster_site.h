#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/cluster/campaign.h"
#include "engine/cluster/case_run.h"
#include "engine/core/check.h"
#include "engine/io/atomic_file.h"

namespace pedicel::cluster {

/// A folder with an input, and a plan whose cases are commands of the shell.
class Site : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    before_ = std::filesystem::current_path();
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ("cluster_" + std::string(test->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    std::filesystem::current_path(folder_);
    io::write_file_atomically("input.txt", "7\n");
  }
  void TearDown() override { std::filesystem::current_path(before_); }

  static ProgramAbout about() {
    return {"1.2.3", "abc", [](const std::string& asked) { return asked.empty() ? "SET" : asked; }};
  }

  /// Each case runs `script` with its folder as $1 and its number as $3; $2 is the instruction set.
  static Plan plan(const std::string& script, int cases) {
    Plan plan;
    plan.verb = "try";
    plan.common = {"-c", script, "sh", "{out}"};
    plan.inputs = {"input.txt"};
    for (int i = 0; i < cases; ++i)
      plan.cases.push_back({"case " + std::to_string(i), {std::to_string(i)}});
    return plan;
  }

  /// With the shell in place of this program.
  static TaskFile tasks(const std::string& script, int cases) {
    TaskFile made = tasks_of(plan(script, cases), about());
    made.head.file = "/bin/sh";
    return made;
  }

  std::filesystem::path folder_, before_;
};

}  // namespace pedicel::cluster
