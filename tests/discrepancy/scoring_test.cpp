// What a verdict is worth, on verdicts made by hand: every call, sizes by what data can tell, the
// share of the true model's gain, the bounds of the table, and files that a stop cut short.
#include "tests/discrepancy/scoring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "engine/io/atomic_file.h"
#include "tests/discrepancy/score_report.h"
#include "tests/discrepancy/score_table.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::hidden {
namespace {

using discrepancy::Estimate;
using discrepancy::NamedCause;
using discrepancy::Outcome;
using discrepancy::Verdict;
using Kind = CaseOrder::Kind;
using Names = std::vector<std::string>;

plant::Effect effect(const std::string& name,
                     std::map<std::string, std::vector<double>> numbers = {}) {
  plant::Effect e;
  e.name = name;
  e.numbers = std::move(numbers);
  return e;
}

HiddenCase case_of(Kind kind, const std::vector<std::string>& hidden) {
  HiddenCase c;
  c.order.kind = kind;
  c.order.hidden = hidden;
  c.order.size = 4;
  if (kind == Kind::effect || kind == Kind::pair)
    for (const std::string& name : hidden) c.causes.push_back(effect(name));
  if (kind == Kind::look_alike) c.causes.push_back(effect(hidden.front()));
  return c;
}

Verdict verdict_of(Outcome outcome, const std::vector<std::string>& names = {}) {
  Verdict v;
  v.outcome = outcome;
  for (const std::string& name : names) {
    v.causes.emplace_back();
    v.causes.back().name = name;
  }
  return v;
}

Call call(const HiddenCase& c, const Verdict& v) {
  return score(c, v, {}).call;
}

TEST(Scoring, NullDataMustStayQuiet) {
  const HiddenCase c = case_of(Kind::null, {});
  EXPECT_EQ(call(c, verdict_of(Outcome::adequate)), Call::right);
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"damping_time"})), Call::parameter_alarm);
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"damping_time", "wind"})), Call::false_alarm);
  EXPECT_EQ(call(c, verdict_of(Outcome::ambiguous, {"wind", "gust"})), Call::false_alarm);
  EXPECT_EQ(call(c, verdict_of(Outcome::unknown)), Call::false_alarm);
  EXPECT_EQ(call(c, verdict_of(Outcome::numerical)), Call::false_alarm);
}

TEST(Scoring, OneEffectNeedsItsNameAndNoOther) {
  HiddenCase c = case_of(Kind::effect, {"wind"});
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"wind"})), Call::right);
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"gust"})), Call::wrong);
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"wind", "latency"})), Call::wrong);
  EXPECT_EQ(call(c, verdict_of(Outcome::ambiguous, {"gust", "wind"})), Call::held);
  EXPECT_EQ(call(c, verdict_of(Outcome::ambiguous, {"gust", "latency"})), Call::not_held);
  EXPECT_EQ(call(c, verdict_of(Outcome::unknown)), Call::unknown);
  EXPECT_EQ(call(c, verdict_of(Outcome::adequate)), Call::missed);
  EXPECT_EQ(call(c, verdict_of(Outcome::bad_data)), Call::refused);
  // A modulus that was off is no wrong name where it was off.
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"youngs_modulus"})), Call::wrong);
  c.refitted = {effect("youngs_modulus")};
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"youngs_modulus"})), Call::missed);
  EXPECT_EQ(call(c, verdict_of(Outcome::named, {"youngs_modulus", "wind"})), Call::right);
}

TEST(Scoring, TwoEffectsLookAlikesAndStrangers) {
  const HiddenCase pair = case_of(Kind::pair, {"extra_mass", "latency"});
  EXPECT_EQ(call(pair, verdict_of(Outcome::named, {"latency", "extra_mass"})), Call::right);
  EXPECT_EQ(call(pair, verdict_of(Outcome::named, {"latency"})), Call::partial);
  EXPECT_EQ(call(pair, verdict_of(Outcome::named, {"latency", "wind"})), Call::wrong);
  const HiddenCase alike = case_of(Kind::look_alike, {"base_compliance", "weak_segment"});
  EXPECT_EQ(call(alike, verdict_of(Outcome::ambiguous, {"weak_segment", "base_compliance"})),
            Call::right);
  EXPECT_EQ(call(alike, verdict_of(Outcome::ambiguous, {"weak_segment", "yield"})), Call::not_held);
  EXPECT_EQ(call(alike, verdict_of(Outcome::named, {"base_compliance"})), Call::sure);
  EXPECT_EQ(call(alike, verdict_of(Outcome::named, {"weak_segment"})), Call::wrong);
  HiddenCase outside = case_of(Kind::outside, {"string"});
  EXPECT_EQ(call(outside, verdict_of(Outcome::unknown)), Call::right);
  EXPECT_EQ(call(outside, verdict_of(Outcome::named, {"wind"})), Call::wrong);
  EXPECT_EQ(call(outside, verdict_of(Outcome::adequate)), Call::missed);
  outside.refitted = {effect("youngs_modulus"), effect("damping_time")};
  EXPECT_EQ(call(outside, verdict_of(Outcome::named, {"damping_time"})), Call::missed);
  EXPECT_EQ(call(outside, verdict_of(Outcome::named, {"damping_time", "wind"})), Call::wrong);
}

// Exactly: modulus and damping are part of what is off, and a detail is no name.
TEST(Scoring, WhoNamesAllThatIsOff) {
  HiddenCase c = case_of(Kind::effect, {"wind"});
  c.refitted = {effect("youngs_modulus"), effect("damping_time")};
  const auto exactly = [&](const Names& said, const Names& details = {}) {
    Verdict verdict = verdict_of(Outcome::named, said);
    for (const std::string& name : details) {
      NamedCause detail;
      detail.name = name;
      verdict.details.push_back(detail);
    }
    return named_exactly(score(c, verdict, {}));
  };
  EXPECT_TRUE(exactly({"wind", "damping_time", "youngs_modulus"}));
  EXPECT_TRUE(exactly({"wind", "youngs_modulus"}, {"damping_time", "creep"}));
  EXPECT_FALSE(exactly({"wind", "youngs_modulus"}));
  EXPECT_FALSE(exactly({"wind", "damping_time", "youngs_modulus", "creep"}));
  const Score read = from_line(to_line(score(c, verdict_of(Outcome::named, {"wind"}), {})));
  EXPECT_EQ(read.off_too, (Names{"youngs_modulus", "damping_time"}));
  EXPECT_FALSE(named_exactly(read));
  EXPECT_FALSE(named_exactly(score(c, verdict_of(Outcome::ambiguous, {"wind"}), {})));
}

// refitted 3, true model 1.1, extended 1.29: (3 - 1.29) / (3 - 1.1) = 0.9. Where the true model
// gains fewer than 10 noise units (N (r^2 - t^2) < 100) there is no share.
TEST(Scoring, GainIsAShareOfTheTrueModels) {
  const HiddenCase c = case_of(Kind::effect, {"wind"});
  Verdict v = verdict_of(Outcome::named, {"wind"});
  v.check = {3.5, 3.0, 1.29};
  const TrueError truth{1.1, 3000};
  ASSERT_TRUE(score(c, v, truth).gain_share);
  EXPECT_NEAR(*score(c, v, truth).gain_share, 0.9, 1e-12);
  EXPECT_FALSE(score(c, v, {1.1, 12}).gain_share);
  EXPECT_FALSE(score(c, verdict_of(Outcome::adequate), truth).gain_share);
  v.check.refitted.reset();
  EXPECT_FALSE(score(c, v, truth).gain_share);
}

NamedCause said(const std::string& name, std::map<std::string, std::vector<Estimate>> parameters) {
  NamedCause cause;
  cause.name = name;
  cause.parameters = std::move(parameters);
  return cause;
}

// Equal force: half the area in a wind of sqrt(2) times the speed. Its interval is that of the
// corners, 0.018 x 1.9 to 0.022 x 2.1.
TEST(CauseSize, ComparesWhatDataCanTell) {
  const plant::Effect wind = effect("wind", {{"drag_area", {0.04}}, {"velocity", {1.0, 0.0, 0.0}}});
  const double v = std::sqrt(2.0);
  const SizeError same = size_error(
      wind,
      said("wind",
           {{"drag_area", {{0.02, 0.018, 0.022, ""}}},
            {"velocity", {{v, std::sqrt(1.9), std::sqrt(2.1), ""}, {0, 0, 0, ""}, {0, 0, 0, ""}}}}),
      150.0);
  EXPECT_NEAR(same.error, 0.0, 1e-12);
  EXPECT_EQ(same.inside, 1);
  EXPECT_EQ(same.entries, 1);

  const SizeError weak = size_error(effect("weak_segment", {{"factor", {0.5}}, {"length", {0.1}}}),
                                    said("weak_segment", {{"factor", {{0.8, 0.79, 0.81, ""}}},
                                                          {"length", {{0.4, 0.39, 0.41, ""}}}}),
                                    150.0);
  EXPECT_NEAR(weak.error, 0.0, 1e-12);  // (1/0.5 - 1) 0.1 = (1/0.8 - 1) 0.4

  const SizeError law =
      size_error(effect("material_nonlinearity", {{"coefficient", {0.2}}, {"k0", {2.0}}}),
                 said("material_nonlinearity",
                      {{"coefficient", {{0.9, 0.88, 0.89, ""}}}, {"k0", {{4, 4, 4, ""}}}}),
                 150.0);
  EXPECT_NEAR(law.error, 0.125, 1e-12);  // 0.9/16 against 0.2/4
  EXPECT_EQ(law.inside, 0);

  // A factor vanishes at 1, an anisotropy counts the same from either side.
  EXPECT_NEAR(size_error(effect("marker_scale", {{"factor", {1.04}}}),
                         said("marker_scale", {{"factor", {{1.02, 1.01, 1.05, ""}}}}), 150.0)
                  .error,
              0.5, 1e-9);
  EXPECT_NEAR(size_error(effect("anisotropy", {{"ratio", {2.0}}}),
                         said("anisotropy", {{"ratio", {{0.5, 0.4, 0.6, ""}}}}), 150.0)
                  .error,
              0.0, 1e-12);
  // The grip's own compliance: 1/100 - 1/150 hidden, 1/75 - 1/150 said.
  EXPECT_NEAR(size_error(effect("grip_compliance", {{"stiffness", {100.0}}}),
                         said("grip_compliance", {{"stiffness", {{75, 70, 80, ""}}}}), 150.0)
                  .error,
              1.0, 1e-9);
}

TEST(CauseSize, VectorsOpenEndsAndPlaces) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  const SizeError offset = size_error(
      effect("marker_offset", {{"offset", {0.003, 0.0, 0.004}}}),
      said(
          "marker_offset",
          {{"offset", {{0.003, 0.002, 0.004, ""}, {0.003, 0.001, 0.005, ""}, {0.004, -1, 1, ""}}}}),
      150.0);
  EXPECT_NEAR(offset.error, 0.6, 1e-12);
  EXPECT_EQ(offset.inside, 2);
  EXPECT_EQ(offset.entries, 3);

  plant::Effect mass = effect("extra_mass", {{"mass", {0.01}}});
  mass.place = plant::CurvePlace{"stem", 0.7, {}};
  NamedCause heavy = said("extra_mass", {{"mass", {{0.02, 0.0, endless, ""}}}});
  heavy.where = plant::CurvePlace{"stem", 0.8, {}};
  EXPECT_NEAR(size_error(mass, heavy, 150.0).place, 0.1, 1e-12);
  EXPECT_EQ(size_error(mass, heavy, 150.0).inside, 1);
  heavy.where->curve = "branch";
  EXPECT_TRUE(std::isnan(size_error(mass, heavy, 150.0).place));
  // A parameter that is not there cannot be compared.
  EXPECT_TRUE(std::isnan(size_error(mass, said("extra_mass", {}), 150.0).error));
}

// Wilson's interval for 9 of 10 at z = 1.959964: 0.5958 to 0.9821; for 0 of 120: 0 to 3.1 %.
TEST(ScoreTable, BoundsOfShares) {
  EXPECT_NEAR(share(9, 10).low, 0.5958, 1e-4);
  EXPECT_NEAR(share(9, 10).high, 0.9821, 1e-4);
  EXPECT_EQ(share(0, 120).low, 0.0);
  EXPECT_NEAR(share(0, 120).high, 1.959964 * 1.959964 / (120 + 1.959964 * 1.959964), 1e-12);
  EXPECT_TRUE(std::isnan(share(0, 0).value));
}

// Of 20 values the 95 % interval of the median runs from the 6th to the 15th (95.9 %): the
// textbook's table. Of five values no interval of this kind exists: 2 / 32 is more than 5 %.
TEST(ScoreTable, BoundsOfQuantiles) {
  std::vector<double> values;
  for (int i = 20; i > 0; --i) values.push_back(i);
  const Quantile median = quantile(values, 0.5);
  EXPECT_DOUBLE_EQ(median.value, 10.5);
  EXPECT_DOUBLE_EQ(median.low, 6.0);
  EXPECT_DOUBLE_EQ(median.high, 15.0);
  const Quantile few = quantile({1, 2, 3, 4, 5}, 0.5);
  EXPECT_DOUBLE_EQ(few.value, 3.0);
  EXPECT_TRUE(std::isinf(few.low) && std::isinf(few.high));
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.1).value, 1.0);
}

TableRow row(const std::vector<TableRow>& rows, const std::string& figure) {
  for (const TableRow& r : rows)
    if (r.figure == figure) return r;
  ADD_FAILURE() << figure;
  return {};
}

std::vector<Score> some_scores() {
  const auto numbered = [](Score s, int number) {
    s.number = number;
    return s;
  };
  const auto led = [](Score s, double lead) {
    s.lead = lead;
    return s;
  };
  const auto placed = [](Score s, const std::string& kind, double away) {
    s.force_kind = kind;
    s.force_away = away;
    return s;
  };
  const auto unsure = [](Score s) {
    s.force_error = 0.16;
    s.other_kinds = {"string"};
    return s;
  };
  const HiddenCase quiet = case_of(Kind::null, {}), wind = case_of(Kind::effect, {"wind"});
  return {
      numbered(score(quiet, verdict_of(Outcome::adequate), {}), 0),
      numbered(score(quiet, verdict_of(Outcome::named, {"density"}), {}), 1),
      numbered(led(score(wind, verdict_of(Outcome::named, {"wind"}), {}), 40.0), 2),
      numbered(score(wind, verdict_of(Outcome::named, {"gust"}), {}), 3),
      numbered(
          led(score(wind, verdict_of(Outcome::ambiguous, {"gust", "wind", "yield"}), {}), -0.5), 4),
      numbered(placed(score(case_of(Kind::outside, {"stake"}), verdict_of(Outcome::unknown), {}),
                      "stop", 0.04),
               5),
      numbered(
          unsure(placed(score(case_of(Kind::outside, {"string"}), verdict_of(Outcome::unknown), {}),
                        "stop", 0.3)),
          6)};
}

TEST(ScoreTable, CountsEveryKindAmongItsOwn) {
  const std::vector<TableRow> rows = score_table(some_scores());
  EXPECT_DOUBLE_EQ(row(rows, "false alarms on null data").value, 0.5);
  const TableRow right = row(rows, "right name, one effect, 2 x the smallest and above");
  EXPECT_DOUBLE_EQ(right.value, 1.0 / 3.0);
  EXPECT_EQ(right.count, 3);
  // The one that the data leave open does not count; the one whose lead is not known does.
  const TableRow parted = row(rows, "- where the data part the true cause from every other");
  EXPECT_DOUBLE_EQ(parted.value, 0.5);
  EXPECT_EQ(parted.count, 2);
  EXPECT_EQ(row(rows, "- where they do not: the truth alone or in the set").count, 1);
  EXPECT_DOUBLE_EQ(row(rows, "wrong name said with confidence").value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(row(rows, "\"cannot tell\" set holds the truth").value, 1.0);
  EXPECT_DOUBLE_EQ(row(rows, "mean size of the set").value, 3.0);
  EXPECT_DOUBLE_EQ(row(rows, "outside the list: said unknown").value, 1.0);
  EXPECT_DOUBLE_EQ(row(rows, "- the right place, within a tenth of the curve").value, 0.5);
  EXPECT_DOUBLE_EQ(row(rows, "- the right kind").value, 0.5);
  EXPECT_DOUBLE_EQ(row(rows, "- the right kind, or said not to be told from it").value, 1.0);
  EXPECT_DOUBLE_EQ(row(rows,
                       "- the place, within two of the deviations that it is said with, or "
                       "another curve that is said to do as well")
                       .value,
                   1.0);
  EXPECT_TRUE(std::isnan(row(rows, "two effects, both named").value));
  EXPECT_NE(markdown(rows).find("| 33.3 % |"), std::string::npos);
}

TEST(ScoreTable, RecordsAsPeopleMakeThemHaveRowsOfTheirOwn) {
  const auto in_pack = [](Score s, const char* pack, int number) {
    s.pack = pack;
    s.number = number;
    return s;
  };
  std::vector<Score> scores = some_scores();
  const std::vector<TableRow> before = score_table(scores);
  scores.push_back(in_pack(scores[1], "moving", 7));  // an alarm
  scores.push_back(in_pack(scores[0], "rest", 8));
  scores.push_back(in_pack(scores[0], "planar", 9));
  scores.push_back(in_pack(scores[2], "pusher", 10));  // named
  scores.push_back(in_pack(scores[4], "plate", 11));   // among a set
  const std::vector<TableRow> rows = score_table(scores);
  const TableRow alarms = row(rows, "records as people make them: false alarms");
  EXPECT_DOUBLE_EQ(alarms.value, 1.0 / 3.0);
  EXPECT_EQ(alarms.count, 3);
  const TableRow right = row(rows, "- right name alone");
  EXPECT_DOUBLE_EQ(right.value, 0.5);
  EXPECT_EQ(right.count, 2);
  for (const char* other : {"false alarms on null data", "wrong name said with confidence",
                            "mean size of the set", "95 % intervals that hold the truth"})
    EXPECT_EQ(row(rows, other).count, row(before, other).count) << other;
}

TEST(ScoreTable, ConfusionHasOneCellACase) {
  const Confusion matrix = confusion(some_scores());
  int all = 0;
  for (const auto& counts : matrix.count)
    for (const int count : counts) all += count;
  EXPECT_EQ(all, 7);
  const std::string text = markdown(matrix);
  EXPECT_NE(text.find("| wind | gust 1, wind 1, cannot tell, among them 1 |"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| nothing | density 1, nothing 1 |"), std::string::npos) << text;
  EXPECT_NE(text.find("| stake | unknown 1 |"), std::string::npos) << text;
}

TEST(ScoreFile, ResumesAfterAStopInTheMiddleOfALine) {
  const TemporaryFolder folder;
  const auto file = folder / "results.jsonl";
  std::vector<Score> scores = some_scores();
  scores[2].gain_share = 0.93;
  scores[2].lead = 12.5;
  scores[5].force_elsewhere = true;
  scores[2].sizes = {{"wind", 0.04, 1, 1, std::nan("")}};
  for (const Score& s : scores) append_score(file, s);
  std::ofstream(file, std::ios::app) << "{\"case\": 9, \"se";
  Score late = scores[0];
  late.number = 10;
  append_score(file, late);
  const std::vector<Score> back = read_scores(file, 0);
  ASSERT_EQ(back.size(), 8u);
  EXPECT_EQ(back.back().number, 10);
  EXPECT_EQ(to_line(back[2]), to_line(scores[2]));
  EXPECT_TRUE(read_scores(file, 1).empty());
  write_score_report(folder / "", back, 0);
  const std::string page = io::read_file(folder / "report.html");
  EXPECT_NE(page.find("cannot tell, among them"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace pedicel::hidden
