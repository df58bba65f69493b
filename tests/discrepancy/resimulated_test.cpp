// Trials done again with something hidden in the plant: what is hidden shows, the rest stays.
#include "tests/discrepancy/resimulated.h"

#include <gtest/gtest.h>

#include "tests/discrepancy/reference_plants.h"

namespace pedicel::hidden {
namespace {

using discrepancy::Experiment;
using discrepancy::Trial;

// A leaning stem, held by its middle where it stands under its weight and pulled from there.
Experiment pulled_stem() {
  Experiment e;
  e.plant() = reference::straight_stem(0.4, 0.003, 4e8);
  e.plant().curves[0].points[1] = Vec3(0.2, 0, 0.3);
  e.markers = {{"middle", {"stem", 0.5, {}}}, {"tip", {"stem", 1.0, {}}}};
  Trial t;
  t.name = "pull";
  const Vec3 start =
      reference::settled_point({e.plant(), {}, {}}, {}, e.markers[0].place, {0.005, 0.0017});
  t.holds = {{e.markers[0].place, {{0.0, 1.0}, {start, start + Vec3(0, 0.02, 0)}, {}}, 2.0, 50.0}};
  for (int i = 0; i <= 50; ++i) t.markers.time.push_back(0.02 * i);
  t.markers.value.setZero(51, 6);
  t.force = {t.markers.time, Eigen::MatrixXd::Zero(51, 3)};
  e.trials = {t};
  return e;
}

plant::Effect mass_at_the_tip(double mass) {
  plant::Effect e;
  e.name = "extra_mass";
  e.place = plant::CurvePlace{"stem", 1.0, {}};
  e.numbers["mass"] = {mass};
  return e;
}

// Who takes hold of a plant finds it where it stands: nothing pulls at time 0. Of a path that was
// made for the plant without the mass, k times the way between the two does.
TEST(Resimulated, HoldsTakeThePlantWhereItStands) {
  const Experiment before = pulled_stem();
  const auto effects = {mass_at_the_tip(0.01)};
  MeasuringOptions stays;
  stays.follow_plant = false;
  const Trial followed = resimulated(before, effects, {}, {}).trials[0];
  const Trial kept = resimulated(before, effects, {}, stays).trials[0];
  EXPECT_LT(followed.force.value.row(0).norm(), 1e-4);
  EXPECT_GT(kept.force.value.row(0).norm(), 0.05);
  const Vec3 moved =
      followed.holds[0].path.position[0] - before.trials[0].holds[0].path.position[0];
  EXPECT_LT(moved.z(), -0.003);
  EXPECT_EQ(kept.holds[0].path.position, before.trials[0].holds[0].path.position);
}

TEST(Resimulated, NoiseIsAsStatedAndComesFromTheSeed) {
  Experiment e = pulled_stem();
  const Eigen::MatrixXd clean = resimulated(e, {}, {}, {}).trials[0].markers.value;
  e.noise.position_std = 1e-3;
  const Eigen::MatrixXd noisy = resimulated(e, {}, {}, {}).trials[0].markers.value;
  const double n = static_cast<double>(clean.size());
  // The mean square of n normal numbers lies within 5 sqrt(2/n) of 1.
  EXPECT_NEAR((noisy - clean).squaredNorm() / n / 1e-6, 1.0, 5 * std::sqrt(2 / n));
  EXPECT_EQ(resimulated(e, {}, {}, {}).trials[0].markers.value, noisy);
  MeasuringOptions other;
  other.seed = 2;
  EXPECT_NE(resimulated(e, {}, {}, other).trials[0].markers.value, noisy);
}

// A push of a giant, which is none at time 0.
TEST(Resimulated, RefusesWhatDiverges) {
  reference::OutsideEffect push;
  push.kind = reference::OutsideEffect::Kind::push;
  push.place = {"stem", 1.0, {}};
  push.size = 1e12;
  try {
    resimulated(pulled_stem(), {}, {push}, {});
    ADD_FAILURE() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "trial \"pull\": the simulation diverged");
  }
}

TEST(Resimulated, RefusesUnevenSamples) {
  Experiment e = pulled_stem();
  e.trials[0].markers.time[3] += 0.005;
  EXPECT_THROW(resimulated(e, {}, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace pedicel::hidden
