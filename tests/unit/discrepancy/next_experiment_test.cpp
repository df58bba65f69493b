#include "plugins/discrepancy/procedure/next_experiment.h"

#include <gtest/gtest.h>

#include "plugins/discrepancy/procedure/trial_designs.h"
#include "tests/unit/discrepancy/made_diagnosis.h"

namespace pedicel::discrepancy {
namespace {

// A plant that the simulator can run quickly.
MadeData coarse() {
  MadeData made;
  plant::PlantFile& plant = made.experiment.plant();
  plant.shape = plant::Shape::rest;
  plant.material = {5e8, 0.35, 700.0, 0.01};
  plant.connect = 0.01;
  plant.distance = 0.1;
  return made;
}

DataSet noise_of(const Experiment& experiment) {
  DataSet data(experiment);
  data.set_noise(white_noise(MadeData::position_std), white_noise(MadeData::force_std));
  return data;
}

TEST(TrialDesigns, StayWithinWhatWasDone) {
  const MadeData made = coarse();
  DesignScales scales = design_scales(made.experiment);
  EXPECT_EQ(scales.grip.curve, "stem");
  EXPECT_EQ(scales.grip.at, 1.0);
  EXPECT_NEAR(scales.reach, 0.04, 0.005) << "as far as it was pulled";
  EXPECT_NEAR(scales.load, 0.05, 1e-12);
  EXPECT_TRUE(scales.force);
  const auto designs = trial_designs(made.experiment, scales);
  EXPECT_GE(designs.size(), 10u);
  int turned = 0, holds = 0, loads = 0, bases = 0;
  for (const TrialDesign& design : designs) {
    EXPECT_GT(design.minutes, 0.0) << design.action;
    EXPECT_FALSE(design.action.empty());
    EXPECT_EQ(design.trial.markers.value.rows(), design.trial.markers.size());
    EXPECT_LE(design.trial.markers.size(), 1100);
    turned += design.turned;
    holds += !design.trial.holds.empty();
    loads += !design.trial.loads.empty();
    bases += design.trial.base.has_value();
    for (const Hold& hold : design.trial.holds)
      for (const Vec3& p : hold.path.position)
        EXPECT_LE((p - scales.rest).norm(), 1.5 * scales.reach + 1e-9) << design.action;
  }
  EXPECT_EQ(turned, 1);
  EXPECT_GE(holds, 6);
  EXPECT_EQ(loads, 2);
  EXPECT_EQ(bases, 1);
}

// Twice by 180 degrees is not at all; heights and distances stay.
TEST(TrialDesigns, TurnedPlant) {
  const MadeData made = coarse();
  const plant::PlantFile once = turned_plant(made.experiment.plant());
  EXPECT_NEAR(once.curves[1].points[1].x(), -0.2, 1e-12);
  EXPECT_NEAR(once.curves[1].points[1].z(), 0.4, 1e-12);
  EXPECT_EQ(turned_plant(once), made.experiment.plant());
}

// Damping shows where the plant swings freely, after a release or a sudden load, and not in a push
// that is held.
TEST(NextExperiment, SeparatesTwoDampingsByASwing) {
  const MadeData made = coarse();
  const DataSet data = noise_of(made.experiment);
  const Hypothesis none;
  const Hypothesis damped = hypothesis_of("mass_damping", "rate", 2.0, "1/s");
  long simulations = 0;
  const NextExperiment next =
      next_experiment(made.experiment, data, {damped, none}, {{0.1, 1.0 / 240}, 2}, simulations);
  EXPECT_GT(simulations, 20);
  EXPECT_GT(next.separation, 6.0);
  EXPECT_NE(next.sentence.find("mass_damping and the refitted model then differ by"),
            std::string::npos)
      << next.sentence;
  EXPECT_TRUE(next.sentence.find("let go") != std::string::npos ||
              next.sentence.starts_with("Load "))
      << next.sentence;
  ASSERT_EQ(next.series.size(), 2u);
  ASSERT_EQ(next.series[0].size(), next.time.size());
  double most = 0.0;
  for (std::size_t i = 0; i < next.time.size(); ++i)
    most = std::max(most, std::abs(next.series[0][i] - next.series[1][i]));
  EXPECT_GT(most, 3.0 * next.noise) << "the two curves differ where the plot shows them";
}

// The same model twice cannot be told apart by any trial; the sentence then says what else to do.
TEST(NextExperiment, SaysWhenNoTrialSeparates) {
  const MadeData made = coarse();
  const DataSet data = noise_of(made.experiment);
  const Hypothesis same = hypothesis_of("mass_damping", "rate", 2.0, "1/s");
  Hypothesis twin = same;
  twin.name = "leaf_drag";
  long simulations = 0;
  const NextExperiment next =
      next_experiment(made.experiment, data, {same, twin}, {{0.1, 1.0 / 240}, 2}, simulations);
  EXPECT_EQ(next.separation, 0.0);
  EXPECT_EQ(next.sentence.find("No trial"), 0u) << next.sentence;
  EXPECT_NE(next.sentence.find("take off or wet the leaves"), std::string::npos);
}

TEST(NextExperiment, OneExplanationNeedsNone) {
  const MadeData made = coarse();
  long simulations = 0;
  EXPECT_TRUE(next_experiment(made.experiment, noise_of(made.experiment), {Hypothesis{}},
                              {{0.1, 1.0 / 240}, 1}, simulations)
                  .sentence.empty());
  EXPECT_EQ(simulations, 0);
}

TEST(NextLook, GoesWhereTheResidualIsLargest) {
  MadeData made = coarse();
  made.add_noise(1);
  made.change([](int trial, double t, int m, const Vec3&) -> Vec3 {
    return trial == 1 && m == 4 && t > 5.0 && t < 6.0 ? Vec3(0, 0.01, 0) : Vec3::Zero();
  });
  const NextExperiment next =
      next_look(made.experiment, noise_of(made.experiment), made.predictions);
  EXPECT_NE(next.sentence.find("Repeat weights"), std::string::npos) << next.sentence;
  EXPECT_NE(next.sentence.find("beside m5"), std::string::npos) << next.sentence;
  EXPECT_EQ(next.channel, "m5.y");
}

}  // namespace
}  // namespace pedicel::discrepancy
