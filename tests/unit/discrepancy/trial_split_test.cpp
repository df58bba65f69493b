#include "plugins/discrepancy/data/trial_split.h"

#include <gtest/gtest.h>

#include <limits>

#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {
namespace {

using Indices = std::vector<int>;

Trial release(Trial::Use use = Trial::Use::unset) {
  Trial trial;
  trial.use = use;
  trial.holds.push_back({{"stem", 1.0, {}}, {}, 1.0, {}});
  return trial;
}

Trial push() {
  Trial trial;
  trial.holds.push_back({{"stem", 1.0, {}}, {}, std::numeric_limits<double>::infinity(), {}});
  return trial;
}

TrialSplit split(std::vector<Trial> trials) {
  Experiment experiment;
  experiment.trials = std::move(trials);
  return split_trials(experiment);
}

TEST(TrialSplit, FollowsTheFileWhereItSays) {
  const TrialSplit s = split({release(Trial::Use::check), release(Trial::Use::fit), push()});
  EXPECT_EQ(s.check, Indices{0});
  EXPECT_EQ(s.fit, (Indices{1, 2}));  // what is open is fitted, because something is held out
}

TEST(TrialSplit, KeepsBackTheSecondOfAKind) {
  const TrialSplit s = split({release(), push(), release(), release(), push(), push()});
  EXPECT_EQ(s.check, (Indices{2, 4}));  // a third, a kind each
  EXPECT_EQ(s.fit, (Indices{0, 1, 3, 5}));
}

TEST(TrialSplit, KeepsBackTheLastWhereEveryKindIsThereOnce) {
  const TrialSplit s = split({release(), push(), Trial{}});
  EXPECT_EQ(s.check, Indices{2});
  EXPECT_EQ(s.fit, (Indices{0, 1}));
}

TEST(TrialSplit, OfOneOrTwoTrialsFitsThemAll) {
  EXPECT_EQ(split({release()}).fit, Indices{0});
  EXPECT_EQ(split({release(), push()}).fit, (Indices{0, 1}));
  EXPECT_TRUE(split({release(), push()}).check.empty());
}

TEST(TrialSplit, FitsSomethingEvenWhereAllIsToBeChecked) {
  const TrialSplit s = split({release(Trial::Use::check), release(Trial::Use::check)});
  EXPECT_EQ(s.fit, (Indices{0, 1}));
  EXPECT_TRUE(s.check.empty());
}

// What objects is fitted, and the last of its kind held out in its place.
TEST(TrialSplit, ExchangesATrialThatObjects) {
  Experiment experiment;
  experiment.trials = {release(), push(), release(), release(), push(), push()};
  ASSERT_TRUE(exchange_trials(experiment, split_trials(experiment), 2));
  const TrialSplit s = split_trials(experiment);
  EXPECT_EQ(s.fit, (Indices{0, 1, 2, 5}));
  EXPECT_EQ(s.check, (Indices{3, 4}));
  EXPECT_FALSE(exchange_trials(experiment, s, 3)) << "the split is stated now";
}

TEST(TrialSplit, KeepsWhatIsStatedOrCannotBeExchanged) {
  Experiment stated;
  stated.trials = {release(), release(Trial::Use::check), push()};
  EXPECT_FALSE(exchange_trials(stated, split_trials(stated), 1));
  Experiment single;
  single.trials = {release(), push(), release()};
  EXPECT_FALSE(exchange_trials(single, {{0}, {1, 2}}, 1));
}

}  // namespace
}  // namespace pedicel::discrepancy
