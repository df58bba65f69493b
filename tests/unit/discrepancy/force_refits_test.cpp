// Laws that the linear response found, refitted by the simulator.
#include "plugins/discrepancy/force/force_refits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "plugins/discrepancy/simulate/force_term.h"
#include "tests/unit/discrepancy/bent_stem.h"

namespace pedicel::discrepancy {

using namespace testing;

namespace {

/// A stem that was measured while it met a stop, and what the linear response says of one place.
struct MetAStop {
  BentStem bent;
  DataSet data;
  Simulator simulator;
  Evaluator evaluator;
  MissingForceOptions options;
  FitSummary model;
  std::vector<ForcePlace> places;
  LibraryScales scales;

  MetAStop()
      : bent(measured()),
        data(bent.experiment),
        simulator(bent.experiment, {0.04, 1.0 / 480}, 1),
        evaluator(simulator, data) {
    data.set_noise(white_noise(noise_std), white_noise(1.0));
    options.fit.trials = {0, 1};
    model = fit(evaluator, baseline(), options.fit);
    ForceResponses responses(bent.experiment, data, model, options.fit, 0.04, 1);
    for (const int marker : {2, 3}) {  // the stop is at 0.7, between them
      ForcePlace place;
      place.space = responses.force_at(marker);
      place.free = free_history(place.space);
      place.path = responses.path(place.space, place.free.value);
      places.push_back(std::move(place));
    }
    scales.samples = data.samples(options.fit.trials);
    scales.length = bent.stem_length();
    scales.duration = 2.5;
    scales.trials = {"trial_1", "trial_2"};
  }
  static BentStem measured() {
    BentStem stem;
    stem.measure({soft_stop()}, 3);
    return stem;
  }
  std::vector<ForceTerm> laws(const std::string& kind) const {
    std::vector<ForceTerm> found;
    for (const ForcePlace& place : places)
      for (const ForceTerm& law : regress_force(place.space, place.path, scales))
        if (kind_of(law.force) == kind) found.push_back(law);
    return found;
  }
};

// The linear response may like strings best. A stop, which has two numbers less, is tried in the
// place of the one that comes out, too, and is what made the data.
TEST(ForceRefits, TriesAStopInPlaceOfAString) {
  MetAStop met;
  const std::vector<ForceTerm> strings = met.laws("string");
  ASSERT_FALSE(strings.empty());
  std::vector<ForceTerm> laws = strings;
  for (ForceTerm stop : met.laws("stop")) {
    stop.evidence = std::min(stop.evidence, strings.back().evidence) - 1.0;
    laws.push_back(stop);
  }
  ForceRefits refits(met.evaluator, met.model, met.model, met.places, met.scales, met.options);
  refits.run(laws);
  ASSERT_EQ(refits.laws().size(), 2u);
  const ForceTerm &best = refits.laws().front(), &string = refits.laws().back();
  EXPECT_EQ(kind_of(best.force), "stop");
  EXPECT_EQ(kind_of(string.force), "string");
  EXPECT_GT(best.evidence, string.evidence);
  // The place is known to 0.1 or so, and the stiffness goes with it; the side is known well.
  EXPECT_NEAR(best.force.place->at, 0.7, 0.15);
  EXPECT_GT(direction_of(best.force).dot(Vec3(0.8, 0.6, 0.0)), 0.99);
  EXPECT_EQ(kind_of(refits.best().hypothesis.effects.back()), "stop");
}

// Both are attractions to a point, but one grows with distance and the other weakens: the refit of
// one does not find the other.
TEST(ForceRefits, RefitsASpringAndAPullThatWeakensWithDistance) {
  MetAStop met;
  std::vector<ForceTerm> laws = met.laws("attraction");
  ASSERT_FALSE(laws.empty());
  laws.resize(1);
  ForceTerm spring = laws.front();
  spring.force.words["kind"] = "spring";
  spring.force.numbers["stiffness"] = {spring.force.numbers.at("size")[0] /
                                       spring.force.numbers.at("distance")[0]};
  spring.force.numbers.erase("size");
  spring.force.numbers.erase("range");
  spring.parameters = 3;
  spring.evidence += 1.0;
  laws.insert(laws.begin(), spring);
  ForceRefits refits(met.evaluator, met.model, met.model, met.places, met.scales, met.options);
  refits.run(laws);
  std::vector<std::string> kinds;
  for (const ForceTerm& law : refits.laws()) kinds.push_back(kind_of(law.force));
  EXPECT_THAT(kinds, ::testing::UnorderedElementsAre("spring", "attraction"));
}

TEST(ForceRefits, WithoutLawsThereIsNone) {
  MetAStop met;
  ForceRefits refits(met.evaluator, met.model, met.model, met.places, met.scales, met.options);
  refits.run({});
  EXPECT_TRUE(refits.laws().empty());
  EXPECT_EQ(refits.best().why, "not run");
}

}  // namespace

}  // namespace pedicel::discrepancy
