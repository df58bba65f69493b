// The reference simulator against closed forms, against itself on other meshes and steps, and
// against the program's own rods.
#include <gtest/gtest.h>

#include <cmath>

#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/plant/plant_builder.h"
#include "tests/discrepancy/case_setting.h"
#include "tests/discrepancy/reference_plants.h"
#include "tests/discrepancy/reference_trial.h"

namespace pedicel::reference {
namespace {

// EI of the test stems: E pi r^4 / 4.
double rigidity(double E, double radius) {
  return E * M_PI * std::pow(radius, 4) / 4;
}

// Tip deflection of a cantilever under a small tip force: P L^3 / 3EI (Euler-Bernoulli). Hinges of
// compliance l/EI between nodes and l/2EI at the clamp integrate x^2/EI by the trapezoid rule:
// (L^3/3)(1 + 1/(2 n^2)) / EI, so that the discrete value is known, too.
TEST(ReferenceRods, BendAsACantilever) {
  const double L = 0.5, r = 0.004, E = 5e8, P = 1e-4;
  for (const int n : {10, 20, 40}) {
    Subject s{straight_stem(L, r, E), {}, {}};
    TrialPlan t;
    t.gravity.setZero();
    t.loads = {{{"stem", 1.0, {}}, Vec3(0, P, 0)}};
    const double tip = settled_point(s, t, {"stem", 1.0, {}}, {L / n, 0.002}).y();
    const double beam = P * L * L * L / (3 * rigidity(E, r));
    EXPECT_NEAR(tip, beam * (1 + 0.5 / (n * n)), 1e-6 * beam) << n;
  }
}

// First frequency of a cantilever, 1.87510^2 sqrt(EI / (m L^4)) (rotary inertia r^2/4L^2 is 2e-5
// here): read off the time between zero crossings after a small release.
TEST(ReferenceRods, SwingAtTheFirstFrequency) {
  const double L = 0.5, r = 0.004, E = 5e8;
  Subject s{straight_stem(L, r, E), {}, {}};
  TrialPlan t;
  t.gravity.setZero();
  t.duration = 3.0;
  t.interval = 0.002;
  t.loads = {{{"stem", 0.5, {}}, Vec3(0, 1e-4, 0), -1.0, t.interval}};
  s.plant.material.damping_time = 1e-4;  // takes the higher modes away, and 3e-6 of the frequency
  const Record record = run_trial(s, t, {{"m", {"stem", 1.0, {}}}}, {L / 40, 0.001});
  std::vector<double> crossings;
  for (int i = 1; i < record.markers.rows(); ++i) {
    const double a = record.markers(i - 1, 1), b = record.markers(i, 1);
    if (a < 0 && b >= 0) crossings.push_back(record.time[i - 1] + t.interval * a / (a - b));
  }
  ASSERT_GT(crossings.size(), 5u);
  const double period = (crossings.back() - crossings.front()) / (crossings.size() - 1.0);
  const double mass = 700 * M_PI * r * r;
  const double w = 1.875104 * 1.875104 * std::sqrt(rigidity(E, r) / (mass * std::pow(L, 4)));
  EXPECT_NEAR(2 * M_PI / period, w, 2e-3 * w);
}

// Without damping only the integrator takes energy. A third-order method whose stability function
// differs from e^z by C z^4 takes energy of a mode in proportion to h^3 a second: halving the step
// leaves an eighth. Started in (nearly) the first mode.
TEST(ReferenceRods, KeepTheirEnergy) {
  const double L = 0.5;
  Subject s{straight_stem(L, 0.004, 2e8), {}, {}};
  double lost[2];
  for (int k = 0; k < 2; ++k) {
    Tree tree = build_tree(s.plant, {}, {}, L / 10);
    Surroundings around;
    const Place tip = locate(s.plant, tree, "stem", 1.0);
    around.forces.push_back({tip, [](double, double, const Vec3&, const Vec3&) -> PointPush {
                               return {Vec3(0.02, 0, 0), 0.0};
                             }});
    Solver solver(tree, around);
    ASSERT_TRUE(solver.settle());
    solver.surroundings().forces.clear();
    const double h = k == 0 ? 0.001 : 0.0005;
    // What the release puts into the highest modes goes at once, as it should.
    while (solver.time() < 0.5 - 0.5 * h) solver.step(h);
    const double start = solver.energy();
    while (solver.time() < 1.5 - 0.5 * h) solver.step(h);
    Solver still(tree, Surroundings{});
    still.settle();
    lost[k] = (start - solver.energy()) / (start - still.energy());
  }
  EXPECT_GT(lost[1], 0.0);
  EXPECT_LT(lost[1], 2e-3);
  EXPECT_LT(lost[1], lost[0] / 2);
}

// Third order in the step, second in the mesh: against a run with a quarter of the step and of the
// segments, the errors fall at least by 2^2.5 and by 2^1.5.
TEST(ReferenceRods, Converge) {
  Random random(3);
  const hidden::Setting setting = hidden::make_setting(hidden::PlantKind::side_branch, random);
  const Subject s{setting.plant, {}, {}};
  TrialPlan t;
  t.duration = 0.6;
  t.interval = 0.2;
  t.loads = {{setting.tip, Vec3(0.01, 0.04, -0.02), -1.0, 0.2}};
  const auto tip = [&](const Mesh& mesh) {
    return Vec3(run_trial(s, t, {{"m", setting.tip}}, mesh).markers.row(3).transpose());
  };
  const double d = setting.plant.distance;
  const Vec3 exact_in_time = tip({2 * d, 0.0005});
  const double step4 = (tip({2 * d, 0.004}) - exact_in_time).norm();
  const double step2 = (tip({2 * d, 0.002}) - exact_in_time).norm();
  EXPECT_LT(step2, step4 / std::pow(2, 2.5));
  EXPECT_LT(step2, 2e-6);
  const Vec3 exact_in_space = tip({d / 4, 0.002});
  const double mesh2 = (tip({2 * d, 0.002}) - exact_in_space).norm();
  const double mesh1 = (tip({d, 0.002}) - exact_in_space).norm();
  EXPECT_LT(mesh1, mesh2 / std::pow(2, 1.5));
}

// `shape: drawn`: the plant settles where it was drawn, whatever the weight.
TEST(ReferenceRods, StandAsDrawn) {
  Random random(5);
  hidden::Setting setting = hidden::make_setting(hidden::PlantKind::two_branches, random);
  setting.plant.masses = {{{"branch_1", 0.7, {}}, 0.004}};
  const Subject s{setting.plant, {}, {}};
  const plant::PlantCurve& branch = setting.plant.curves[1];
  const Vec3 tip = settled_point(s, {}, {"branch_1", 1.0, {}}, {0.01, 0.002});
  EXPECT_LT((tip - branch.points.back()).norm(), 1e-8);
}

/// The program's own solver on the same plant: held by a force, let go at 0; tips at each 0.1 s.
std::vector<Vec3> by_the_program(const plant::PlantFile& plant, const plant::CurvePlace& at,
                                 const Vec3& force, double dt) {
  Diagnostics diagnostics;
  plant::BuiltPlant built = plant::build_plant(plant, {}, diagnostics).value();
  const plant::PlacedPoint place = built.locate(plant.curve_index(at.curve), at.at);
  cosserat::RodSettings settings;
  settings.tolerance = 1e-9;
  settings.newton_iterations = 20;
  cosserat::RodState state = cosserat::drawn_state(built.model);
  const std::vector<cosserat::Load> loads{{place.element, place.back, force, Vec3::Zero()}};
  cosserat::settle(built.model, state, Vec3(0, 0, -9.81), loads);
  cosserat::RodSystem rods(settings);
  rods.add_plant(built.model);
  rods.set_state(0, state);
  std::vector<Vec3> tips;
  for (int i = 0; i <= 10; ++i) {
    tips.push_back(cosserat::point_on(rods.model(0), rods.state(0), place.element, place.back));
    for (int k = 0; k < std::lround(0.1 / dt); ++k) rods.step(dt, Vec3(0, 0, -9.81));
  }
  return tips;
}

// Two formulations, two integrators and two ways to make a mesh: a released branch, 20 mm wide, at
// each tenth of a second. Both are second order in the mesh; the program has stretch and shear,
// whose share in bending is (r/L)^2, some 1e-5.
TEST(ReferenceRods, AgreeWithTheProgram) {
  Random random(9);
  hidden::Setting setting = hidden::make_setting(hidden::PlantKind::side_branch, random);
  const Vec3 force(0.0, 0.03, -0.02);
  TrialPlan t;
  t.duration = 1.1;
  t.interval = 0.1;
  t.loads = {{setting.tip, force, -1.0, 0.1}};
  const double d = setting.plant.distance;
  const Record record = run_trial({setting.plant, {}, {}}, t, {{"m", setting.tip}}, {d / 4, 0.001});
  setting.plant.distance = d / 4;
  const std::vector<Vec3> tips = by_the_program(setting.plant, setting.tip, force, 1.0 / 8000);
  double worst = 0.0, wide = 0.0;
  for (int i = 0; i <= 10; ++i) {
    const Vec3 ours = record.markers.row(i + 1).transpose();
    worst = std::max(worst, (ours - tips[i]).norm());
    wide = std::max(wide, (tips[i] - tips[10]).norm());
  }
  RecordProperty("worst_um", static_cast<int>(worst * 1e6));
  std::printf("reference against the program: %.4f mm of %.1f mm\n", worst * 1e3, wide * 1e3);
  EXPECT_GT(wide, 0.015);
  EXPECT_LT(worst, 1e-4);
}

}  // namespace
}  // namespace pedicel::reference
