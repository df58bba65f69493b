// What a diagnosis says of its progress never falls.
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "plugins/discrepancy/procedure/diagnosis_log.h"

namespace pedicel::discrepancy {
namespace {

TEST(Progress, NeverFalls) {
  std::vector<double> seen;
  std::vector<std::string> said;
  const auto progress = rising([&](const std::string& what, double share) {
    said.push_back(what);
    seen.push_back(share);
  });
  std::vector<std::string> steps;
  const DiagnosisLog log(progress, {}, steps);
  for (const double share : {0.1, 0.72, 0.62, 0.05, 0.8, 1.7}) log.say("so far", share);
  // What is done is still told where the share stays.
  EXPECT_EQ(seen, (std::vector<double>{0.1, 0.72, 0.72, 0.72, 0.8, 1.0}));
  EXPECT_EQ(said.size(), 6u);
}

// Threads that count tasks tell of them out of turn.
TEST(Progress, NeverFallsFromThreads) {
  std::vector<double> seen;
  const auto progress = rising([&](const std::string&, double share) { seen.push_back(share); });
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&progress, t] {
      for (int i = 0; i < 250; ++i) progress("counting", 0.001 * (4 * i + t));
    });
  threads.clear();
  EXPECT_EQ(seen.size(), 1000u);
  EXPECT_TRUE(std::ranges::is_sorted(seen));
}

TEST(Progress, OfNobodyWhoListensIsNone) {
  EXPECT_FALSE(rising({}));
}

}  // namespace
}  // namespace pedicel::discrepancy
