// Whole diagnoses of hidden cases, one a ctest case: what is hidden must be named, and null data
// must stay quiet. Chosen by a rule (README): of each name the first case of the list with seed 1
// that hides it at 8 to 16 times the smallest identifiable size in a pack of three trials, or,
// where there is none, at 4 to 8 times, the first eighteen names but for the known misses and those
// that have a case of their own; of the packs `push` and `weights` the first null case with white
// and with coloured noise; the first look-alike with three trials. Five more from other seeds.
// Sizes count from where an effect is seen, which is smaller than where it is told apart, but for
// two.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "tests/discrepancy/case_run.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::hidden {

// Named here, or the names of the tests would hold a case's bytes.
void PrintTo(const CaseOrder& order, std::ostream* out) {
  *out << "case " << order.number;
}

namespace {

using Kind = CaseOrder::Kind;

constexpr std::uint64_t seed = 1;
constexpr std::size_t most_names = 18;
// What comes out otherwise there. The records leave open whether a relaxation takes longer than
// they do (and whether damping does not depend on the rate), and whether damping goes with the mass
// or relaxes; a soft grip and a force sensor's gain scale the same push; of a junction at 4 times
// the smallest size another mesh could be the cause.
const std::set<std::string> known_misses{"creep", "relaxation", "mass_damping", "grip_compliance",
                                         "attachment_compliance"};
const std::set<std::string> on_their_own{"stiffness_gradient", "yield"};

bool three_trials(const CaseOrder& order) {
  return order.pack != PackKind::release && order.pack != PackKind::mix &&
         !as_people_make_them(order.pack);
}

template <class Wanted>
void add_first(std::vector<CaseOrder>& chosen, const Wanted& wanted) {
  for (const CaseOrder& order : case_orders())
    if (wanted(order)) {
      chosen.push_back(order);
      return;
    }
}

CaseOrder seen(CaseOrder order) {
  order.told_apart = false;
  return order;
}

std::vector<CaseOrder> chosen_cases() {
  std::vector<CaseOrder> chosen;
  std::set<std::string> names;
  const auto add_names = [&](double least, double most) {
    for (const CaseOrder& order : case_orders())
      if (order.kind == Kind::effect && order.size >= least && order.size <= most &&
          three_trials(order) && names.size() < most_names &&
          !known_misses.contains(order.hidden.front()) &&
          !on_their_own.contains(order.hidden.front()) && names.insert(order.hidden.front()).second)
        chosen.push_back(order);
  };
  add_names(8.0, 16.0);
  add_names(4.0, 8.0);
  for (const PackKind pack : {PackKind::push, PackKind::weights})
    for (const bool coloured : {false, true})
      add_first(chosen, [&](const CaseOrder& order) {
        return order.kind == Kind::null && order.pack == pack && order.coloured == coloured;
      });
  add_first(chosen, [&](const CaseOrder& order) {
    return order.kind == Kind::look_alike && three_trials(order);
  });
  std::ranges::transform(chosen, chosen.begin(), seen);
  return chosen;
}

std::string title(const ::testing::TestParamInfo<CaseOrder>& info) {
  std::string text = std::string(name_of(info.param.kind));
  for (const std::string& name : info.param.hidden) text += "_" + name;
  return text + "_case_" + std::to_string(info.param.number) + "_seed_" + std::to_string(seed);
}

class FoundEffects : public ::testing::TestWithParam<CaseOrder> {};

TEST_P(FoundEffects, ComesOutAsItShould) {
  const TemporaryFolder folder;
  const CaseRun run = run_case(seed, GetParam(), {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right)
      << "called " << name_of(run.score.call) << "; again: hidden_effects --seed " << seed
      << " --case " << GetParam().number << "\n"
      << run.notes;
}

// A latency of 2.3 ms beside an anisotropy. A lag of the sensor does as well within 1.5 nats;
// beside a second cause nobody had asked for it, and the lag was named.
TEST(FoundEffect, WhatTheDataCannotTellBesideWhatIsCertain) {
  const TemporaryFolder folder;
  const CaseOrder& order = case_orders()[49];
  ASSERT_EQ(order.hidden, (std::vector<std::string>{"anisotropy", "latency"}));
  const CaseRun run = run_case(31, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::held) << run.notes;
  std::set<std::string> in_doubt;
  for (const discrepancy::NamedCause& cause : run.verdict.causes)
    if (!cause.instead_of.empty()) in_doubt.insert({cause.name, cause.instead_of});
  EXPECT_EQ(in_doubt, (std::set<std::string>{"latency", "sensor_lag"})) << run.notes;
}

// A modulus that falls by a third of a stem in free vibration: modulus and density take up all but
// a hundredth of it, and with rough derivatives a fit from the size that the rest asks for stopped
// a third of the way, 84 nats behind a weak stretch.
TEST(FoundEffect, GradientAtTheFarEndOfItsValley) {
  const TemporaryFolder folder;
  const CaseOrder order = seen(case_orders()[408]);
  ASSERT_EQ(order.hidden, std::vector<std::string>{"stiffness_gradient"});
  const CaseRun run = run_case(14, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right) << run.notes;
  EXPECT_EQ(run.score.sizes.size(), 1u);
}

// A yield that is passed by 0.5 % is found from few starts alone. A creep, which goes part of its
// way, came first and stayed when the yield was found beside it, though it brought nothing there.
TEST(FoundEffect, YieldThatACreepStoodInFor) {
  const TemporaryFolder folder;
  const CaseOrder order = seen(case_orders()[143]);
  ASSERT_EQ(order.hidden, std::vector<std::string>{"yield"});
  const CaseRun run = run_case(17, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right) << run.notes;
  EXPECT_EQ(run.score.sizes.size(), 1u);
}

// A yield that is passed by 1 %. Where the sharpest bend of a coarse mesh is sharper than that of a
// fine one, a threshold fitted there does nothing here, and no derivative leads back.
TEST(FoundEffect, YieldFittedBeyondTheSharpestBendOfAFinerMesh) {
  const TemporaryFolder folder;
  const CaseOrder& order = case_orders()[31];
  ASSERT_EQ(order.hidden, std::vector<std::string>{"yield"});
  const CaseRun run = run_case(18, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right) << run.notes;
  EXPECT_EQ(run.score.sizes.size(), 1u);
}

// A string 200 times the smallest that can be seen: no known cause comes near it, and three of them
// on top of each other were searched for at length. The coarse simulator put it at 0.14 of the
// stem.
TEST(FoundEffect, StringThatNoKnownCauseComesNear) {
  const TemporaryFolder folder;
  CaseOrder order = seen(case_orders()[13]);
  ASSERT_EQ(order.hidden, std::vector<std::string>{"string"});
  order.size = 200.0;
  const CaseRun run = run_case(21, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right) << run.notes;
  EXPECT_NE(run.verdict.remainder.find("the best known cause, "), std::string::npos) << run.notes;
  const std::set<std::string> kinds{"string", "stop"};  // a far string is a stop
  EXPECT_TRUE(kinds.contains(run.score.force_kind)) << run.score.force_kind;
  ASSERT_TRUE(run.score.force_away);
  EXPECT_LT(*run.score.force_away, 0.1);
}

// A push of 0.4 mN, 20 noise units in all and ten in each of four trials: no trial by itself shows
// it, and no known cause looks for it.
TEST(FoundEffect, PushTooQuietForAnyTrialAlone) {
  const TemporaryFolder folder;
  const CaseOrder& order = case_orders()[40];
  ASSERT_EQ(order.hidden, std::vector<std::string>{"push"});
  const CaseRun run = run_case(18, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right) << run.notes;
  EXPECT_EQ(run.score.force_kind, "periodic push") << run.notes;
  ASSERT_TRUE(run.score.force_away);
  EXPECT_LT(*run.score.force_away, 0.1);
}

// Records as people make them, of seed 31: a swing that has begun, a plate at the foot,
// deflections at rest.
class FoundInRecords : public ::testing::TestWithParam<int> {};

TEST_P(FoundInRecords, ComesOutAsItShould) {
  const TemporaryFolder folder;
  const CaseOrder& order = case_orders()[GetParam()];
  ASSERT_TRUE(as_people_make_them(order.pack));
  const CaseRun run = run_case(31, order, {folder / "", 1, nullptr});
  EXPECT_EQ(run.score.call, Call::right) << run.notes;
}

std::string record_title(const ::testing::TestParamInfo<int>& info) {
  const CaseOrder& order = case_orders()[info.param];
  return std::string(name_of(order.pack)) + "_" +
         (order.hidden.empty() ? std::string("null") : order.hidden.front()) + "_case_" +
         std::to_string(info.param);
}

INSTANTIATE_TEST_SUITE_P(Records, FoundInRecords, ::testing::Values(504, 506, 508, 513),
                         record_title);
INSTANTIATE_TEST_SUITE_P(Hidden, FoundEffects, ::testing::ValuesIn(chosen_cases()), title);

}  // namespace
}  // namespace pedicel::hidden
