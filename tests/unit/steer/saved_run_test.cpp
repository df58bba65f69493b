#include "app/steer/saved_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/check.h"

namespace pedicel::app {
namespace {

SavedRun some_run() {
  SavedRun run;
  run.model = 0x0123456789abcdefull;
  run.state = 0xfedcba9876543210ull;
  run.steps = 17;
  run.acts.push_back({0, Act::Kind::position, "", {0.1, std::nan(""), -1.0e-300}});
  run.acts.push_back({3, Act::Kind::force, "truss/fruit 5", {1.0, 0, 0, -0.5, 0, 0, 1.0 / 3.0}});
  run.acts.push_back({9, Act::Kind::set, "material.density=900", {}});
  return run;
}

TEST(SavedRun, ComesBackExactly) {
  const SavedRun run = some_run(), again = saved_run_of_text(to_text(run));
  EXPECT_EQ(again.model, run.model);
  EXPECT_EQ(again.state, run.state);
  EXPECT_EQ(again.steps, run.steps);
  ASSERT_EQ(again.acts.size(), run.acts.size());
  EXPECT_TRUE(std::isnan(again.acts[0].numbers[1]));
  for (std::size_t i = 1; i < run.acts.size(); ++i) EXPECT_TRUE(again.acts[i] == run.acts[i]) << i;
  EXPECT_EQ(again.acts[0].numbers[2], run.acts[0].numbers[2]);
}

TEST(SavedRun, RefusesWhatIsNone) {
  const std::string text = to_text(some_run());
  for (const std::string& bad :
       {std::string(), std::string("something else"), text.substr(0, 30),
        text.substr(0, text.size() - 30), text + "4 2 1", text + "4 99 0 x\n", "x" + text})
    EXPECT_THROW(saved_run_of_text(bad), UsageError) << bad;
}

}  // namespace
}  // namespace pedicel::app
