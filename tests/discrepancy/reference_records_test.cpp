// Records as people make them, by the reference simulator: what a plate at the foot feels, probes
// that lead along one axis, swings that have begun, deflections at rest. Against beam theory,
// statics and Newton's law; and the folders of such cases, read back.
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "tests/discrepancy/hidden_case.h"
#include "tests/discrepancy/reference_plants.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::reference {
namespace {

struct Cantilever {
  double length = 0.5, radius = 0.004, modulus = 5e8;
  double rigidity() const { return modulus * M_PI * std::pow(radius, 4) / 4; }
  double tip_stiffness() const { return 3 * rigidity() / std::pow(length, 3); }  // N/m
  double mass() const { return 700 * M_PI * radius * radius * length; }
  Subject subject() const { return {straight_stem(length, radius, modulus), {}, {}}; }
};

const std::vector<MarkerPlan> at_tip{{"tip", {"stem", 1.0, {}}}};

TrialPlan weighed(double duration, double interval) {
  TrialPlan t;
  t.duration = duration;
  t.interval = interval;
  t.measures_wrench = true;
  return t;
}

// P at the tip bends it by P L^3/3EI, and the foot carries P L: by the deflection, M = 3EI/L^2 y.
// (Hinges integrate by the trapezoid rule: 1 + 1/2n^2.)
TEST(ReferenceFoot, CarriesTheMomentOfATipLoad) {
  const Cantilever beam;
  TrialPlan t = weighed(0.0, 0.01);
  t.gravity.setZero();
  t.loads = {{{"stem", 1.0, {}}, Vec3(0, 1e-3, 0)}};
  constexpr int n = 20;
  const Record record = run_trial(beam.subject(), t, at_tip, {beam.length / n, 0.002});
  EXPECT_NEAR(record.wrench(0, 1), -1e-3, 1e-9);
  EXPECT_NEAR(record.wrench(0, 3), 1e-3 * record.markers(0, 2), 1e-9);  // -r x F
  const double bent = record.markers(0, 1) / (1 + 0.5 / (n * n));
  EXPECT_NEAR(record.wrench(0, 3), 3 * beam.rigidity() / std::pow(beam.length, 2) * bent, 2e-7);
}

// The whole weight, and its moment where the stem leans: a rigid stem of length L whose tip is at x
// has its centre at x/2.
TEST(ReferenceFoot, CarriesTheWeight) {
  Cantilever stiff;
  stiff.modulus = 1e13;
  Subject leaning = stiff.subject();
  leaning.plant.curves[0].points = {Vec3::Zero(), Vec3(0.1, 0.05, 0.4)};
  const TrialPlan t = weighed(0.1, 0.02);
  const Record record = run_trial(leaning, t, at_tip, {0.02, 0.002});
  const double mass = 700 * M_PI * 0.004 * 0.004 * Vec3(0.1, 0.05, 0.4).norm();
  ASSERT_EQ(record.wrench.rows(), 6);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(record.wrench(i, 2), 9.81 * mass, 1e-6) << i;
    EXPECT_NEAR(record.wrench(i, 3), 9.81 * mass * 0.025, 1e-6) << i;
    EXPECT_NEAR(record.wrench(i, 4), -9.81 * mass * 0.05, 1e-6) << i;
  }
}

// One rigid segment on a hinge of stiffness K = 2EI/L swings. The hinge's moment on it is -K phi;
// the force is mass times the acceleration of its centre, less gravity.
TEST(ReferenceFoot, CarriesWhatSwings) {
  const double L = 0.2;
  const Cantilever beam{L, 0.004, 1e8};
  TrialPlan t = weighed(0.4, 0.001);
  t.loads = {{{"stem", 1.0, {}}, Vec3(0, 0.02, 0), -1.0, 0.002}};
  const Record record = run_trial(beam.subject(), t, at_tip, {1.0, 0.0005});
  const double K = 2 * beam.rigidity() / L;
  double most = 0.0;
  for (int i = 4; i + 1 < record.wrench.rows(); ++i) {
    const double phi = std::asin(record.markers(i, 1) / L);
    most = std::max(most, std::abs(phi));
    EXPECT_NEAR(record.wrench(i, 3), K * phi, 2e-3 * K * 0.03) << i;
    for (const int k : {1, 2}) {
      const double centre =
          0.5e6 * (record.markers(i + 1, k) - 2 * record.markers(i, k) + record.markers(i - 1, k));
      EXPECT_NEAR(record.wrench(i, k), beam.mass() * (centre + (k == 2 ? 9.81 : 0.0)), 1e-3) << i;
    }
  }
  EXPECT_GT(most, 0.02);
}

HoldPlan probe_at(const Vec3& position, const Vec3& axis) {
  HoldPlan hold;
  hold.place = {"stem", 1.0, {}};
  hold.path = {{0.0}, {position}, {}};
  hold.stiffness = 20.0;
  hold.axes = {axis};
  return hold;
}

// Led along one axis a tip goes where a force along it takes it, and comes down by 3/5 y^2/L.
TEST(ReferenceProbe, LeadsAlongItsAxisAlone) {
  const Cantilever beam;
  const double series = 1 / (1 / 20.0 + 1 / beam.tip_stiffness());
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(-0.6, 0.8, 0)}) {
    TrialPlan t = weighed(0.0, 0.02);
    t.gravity.setZero();
    t.measures_force = true;
    t.holds = {probe_at(0.02 * axis + Vec3(0, 0, 0.3), axis)};  // its height does not matter
    const Record record = run_trial(beam.subject(), t, at_tip, {beam.length / 40, 0.002});
    ASSERT_TRUE(record.settled);
    const Vec3 force = record.force.row(0).transpose(), tip = record.markers.row(0).transpose();
    EXPECT_NEAR(force.dot(axis) / (0.02 * series), 1.0, 5e-3);
    EXPECT_LT(Vec3(force - force.dot(axis) * axis).norm(), 1e-12);
    const double led = axis.dot(tip);
    EXPECT_NEAR(force.dot(axis), 20.0 * (0.02 - led), 2e-3 * force.norm());
    EXPECT_NEAR(beam.length - tip.z(), 0.6 * led * led / beam.length, 1e-5);
    EXPECT_LT(Vec3(tip - led * axis - tip.z() * Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_LT(Vec3(record.wrench.row(0).head<3>().transpose() + force).norm(), 1e-9);
  }
}

// Two axes: each by itself; the third is free.
TEST(ReferenceProbe, LeadsAlongTwoAxes) {
  const Cantilever beam;
  const double series = 1 / (1 / 20.0 + 1 / beam.tip_stiffness());
  TrialPlan t;
  t.duration = 0.0;
  t.gravity.setZero();
  t.measures_force = true;
  t.holds = {probe_at(Vec3(0.004, 0.003, 0.3), Vec3::UnitX())};
  t.holds[0].axes.push_back(Vec3::UnitY());
  const Record record = run_trial(beam.subject(), t, at_tip, {beam.length / 40, 0.002});
  EXPECT_NEAR(record.force(0, 0) / (0.004 * series), 1.0, 5e-3);
  EXPECT_NEAR(record.force(0, 1) / (0.003 * series), 1.0, 5e-3);
  EXPECT_NEAR(record.force(0, 2), 0.0, 1e-12);
}

// From 10 mm beside it a pusher goes slowly to 20 mm and back: it pulls at no time, and the stem
// stands where it stood whenever it is behind it.
TEST(ReferenceProbe, OneThatOnlyPushesNeverPulls) {
  const Cantilever beam;
  Subject damped = beam.subject();
  damped.plant.material.damping_time = 0.02;
  TrialPlan t;
  t.duration = 6.0;
  t.measures_force = true;
  t.gravity.setZero();
  HoldPlan hold = probe_at(Vec3::Zero(), Vec3::UnitX());
  hold.one_sided = true;
  hold.stiffness = 500.0;
  hold.path = {};
  const auto led = [](double time) {
    return -0.01 + 0.03 * (0.5 - 0.5 * std::cos(2 * M_PI * time / 6.0));
  };
  for (int i = 0; i <= 300; ++i) {
    hold.path.time.push_back(0.02 * i);
    hold.path.position.emplace_back(led(0.02 * i), 0.0, beam.length);
  }
  t.holds = {hold};
  const Record record = run_trial(damped, t, at_tip, {beam.length / 10, 0.005});
  EXPECT_NEAR(record.markers(0, 0), 0.0, 1e-9);
  EXPECT_GE(record.force.col(0).minCoeff(), 0.0);
  EXPECT_NEAR(record.force(150, 0) / (beam.tip_stiffness() * 0.02), 1.0, 2e-2);
  for (int i = 0; i <= 300; ++i) {
    const double x = led(0.02 * i);
    if (std::abs(x) > 2e-3) {
      EXPECT_NEAR(record.markers(i, 0), std::max(0.0, x), 1e-3) << i;
    }
    if (x < -2e-3) {
      EXPECT_EQ(record.force(i, 0), 0.0) << i;
    }
  }
}

// A record that begins in mid swing is the rest of the whole one, sample by sample.
TEST(ReferenceMovingStart, IsTheRestOfTheWhole) {
  const Cantilever beam;
  TrialPlan t = weighed(1.0, 0.02);
  t.loads = {{{"stem", 1.0, {}}, Vec3(0.05, 0, 0), -1.0, 0.2}};
  const Record whole = run_trial(beam.subject(), t, at_tip, {0.05, 0.005});
  t.begins = 0.3;
  const Record rest = run_trial(beam.subject(), t, at_tip, {0.05, 0.005});
  ASSERT_EQ(rest.markers.rows(), 36);
  ASSERT_EQ(rest.time.size(), 36u);
  EXPECT_EQ(rest.time.front(), 0.0);
  EXPECT_EQ(rest.markers, whole.markers.bottomRows(36));
  EXPECT_EQ(rest.wrench, whole.wrench.bottomRows(36));
  EXPECT_GT(std::abs(rest.markers(1, 0) - rest.markers(0, 0)), 1e-4);  // it moves
}

// Each row of a static series is what a trial that stands there settles to.
TEST(ReferenceStaticSeries, EachRowIsAtRest) {
  const Cantilever beam;
  TrialPlan t = weighed(2.0, 1.0);
  t.measures_force = true;
  t.is_static = true;
  t.holds = {probe_at(Vec3::Zero(), Vec3::UnitX())};
  t.holds[0].axes.clear();
  t.holds[0].path = {{0, 1, 2}, {{0, 0, 0.5}, {0.02, 0, 0.499}, {0.03, 0.04, 0.496}}, {}};
  const Mesh mesh{0.025, 0.002};
  const Record series = run_trial(beam.subject(), t, at_tip, mesh);
  ASSERT_EQ(series.markers.rows(), 3);
  for (int i = 0; i < 3; ++i) {
    TrialPlan one = weighed(0.0, 1.0);
    one.measures_force = true;
    one.holds = t.holds;
    one.holds[0].path = {{0.0}, {t.holds[0].path.position[i]}, {}};
    const Record alone = run_trial(beam.subject(), one, at_tip, mesh);
    EXPECT_EQ(series.markers.row(i), alone.markers.row(0)) << i;
    EXPECT_EQ(series.force.row(i), alone.force.row(0)) << i;
    EXPECT_EQ(series.wrench.row(i), alone.wrench.row(0)) << i;
  }
  EXPECT_GT((series.markers.row(2) - series.markers.row(0)).norm(), 0.02);
}

}  // namespace
}  // namespace pedicel::reference

namespace pedicel::hidden {
namespace {

// The first null case of a pack, written and read back.
discrepancy::Experiment null_folder(PackKind pack, const TemporaryFolder& folder) {
  for (CaseOrder order : case_orders()) {
    if (order.pack != pack || order.kind != CaseOrder::Kind::null) continue;
    order.plant = PlantKind::stem;
    HiddenCase made = make_case(3, order);
    write_case(folder / "", made);
    Diagnostics diagnostics;
    auto experiment = discrepancy::read_experiment(made.folder, diagnostics);
    EXPECT_TRUE(experiment) << diagnostics.text();
    return experiment ? *experiment : discrepancy::Experiment();
  }
  ADD_FAILURE() << "no such case";
  return {};
}

TEST(RecordCases, AMovingStartHasNoPull) {
  const TemporaryFolder folder;
  const discrepancy::Experiment read = null_folder(PackKind::moving, folder);
  ASSERT_EQ(read.trials.size(), 3u);
  for (const discrepancy::Trial& trial : read.trials) {
    EXPECT_TRUE(trial.window) << trial.name;
    EXPECT_TRUE(trial.holds.empty()) << trial.name;
    ASSERT_EQ(trial.loads.size(), 1u) << trial.name;
    EXPECT_LT(trial.loads[0].from, 2.0) << trial.name;  // 3 s less what was cut off
    EXPECT_LT(trial.duration(), 4.0) << trial.name;
  }
}

TEST(RecordCases, AProbeLeadsAlongAnAxis) {
  const TemporaryFolder folder;
  const discrepancy::Experiment read = null_folder(PackKind::pusher, folder);
  ASSERT_EQ(read.trials.size(), 3u);
  int one_sided = 0;
  for (const discrepancy::Trial& trial : read.trials) {
    ASSERT_EQ(trial.holds.size(), 1u) << trial.name;
    ASSERT_EQ(trial.holds[0].axes.size(), 1u) << trial.name;
    one_sided += trial.holds[0].one_sided;
    const Vec3 way = trial.holds[0].path.position[120] - trial.holds[0].path.position[0];
    EXPECT_NEAR(way.dot(trial.holds[0].axes[0]), way.norm(), 1e-6) << trial.name;
    EXPECT_GT(trial.force.size(), 0) << trial.name;
  }
  EXPECT_EQ(one_sided, 2);
}

TEST(RecordCases, APlateHasItsTable) {
  const TemporaryFolder folder;
  const discrepancy::Experiment read = null_folder(PackKind::plate, folder);
  for (const discrepancy::Trial& trial : read.trials) {
    EXPECT_EQ(trial.wrench.size(), trial.markers.size()) << trial.name;
    EXPECT_EQ(trial.force.size(), 0) << trial.name;
    EXPECT_FALSE(trial.base) << trial.name;
  }
  double mass = 0.0;
  for (const reference::Segment& segment :
       reference::build_tree(read.plant(), {}, {}, 0.02).segments)
    mass += segment.mass;
  // Let go, it carries the weight: within three deviations of a mean of 150 rows.
  ASSERT_EQ(read.trials.at(0).name, "release_1");
  EXPECT_NEAR(read.trials[0].wrench.value.col(2).tail(150).mean(), 9.81 * mass, 0.006);
}

TEST(RecordCases, OneCameraSeesTwoAxes) {
  const TemporaryFolder folder;
  int seen = 0;
  for (const discrepancy::Trial& trial : null_folder(PackKind::planar, folder).trials)
    for (int c = 0; c < trial.markers.value.cols(); ++c)
      seen += std::isfinite(trial.markers.value(0, c));
  EXPECT_EQ(seen, 3 * (2 + 1 + 2 + 2 + 1));  // five markers, of which two are seen along x
}

TEST(RecordCases, RowsAtRestHaveNoTime) {
  const TemporaryFolder folder;
  const discrepancy::Experiment read = null_folder(PackKind::rest, folder);
  EXPECT_TRUE(read.noise.position_std);
  for (const discrepancy::Trial& trial : read.trials) {
    EXPECT_TRUE(trial.is_static) << trial.name;
    EXPECT_EQ(trial.markers.size(), 12) << trial.name;
    EXPECT_EQ(trial.force.size(), 12) << trial.name;
  }
}

}  // namespace
}  // namespace pedicel::hidden
