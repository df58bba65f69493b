// A real silicone cantilever, 3 x 3 x 10 cm, 1070 kg/m3, let go from the horizontal (srl-ethz,
// diffPD_sim2real, commit 825e7b7, MIT, (c) 2021 Soft Robotics Lab, ETH Zurich). Measured:
//   settled tip height below the horizontal  6.5 / 17.4 / 27.1 mm  (own weight / 52 g / 102 g)
//   frequency                                7.77 / 4.34 / 3.38 Hz
// One modulus is fitted to the own-weight drop; the frequencies with the masses are then
// predictions, and within 5 %. The heights with the masses are not (12 and 14 % too small). They
// are with one more parameter, a lever by which the mass hangs beyond the tip (how it was fastened
// is not known): fitted to the 52 g height, it predicts the 102 g height. The same lever in the
// dynamics would lower the frequencies by 14 %, so that it is no whole explanation, and the
// frequencies are judged without it.
#include <gtest/gtest.h>

#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double measured_drop[] = {6.5e-3, 17.4e-3, 27.1e-3};  // m
constexpr double measured_frequency[] = {7.77, 4.34, 3.38};     // Hz
constexpr double tip_mass[] = {0.0, 0.052, 0.102};              // kg
constexpr int elements = 20;

RodModel beam(double modulus, double mass, double lever) {
  const Material material{modulus, 0.49, 1070.0, 0.002};
  RodModel model;
  model.root.rotation = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
  for (int e = 0; e < elements; ++e) {
    add_element(model, e - 1, Vec3(0.1 * (e + 1) / elements, 0, 0),
                rectangle_section(0.03, 0.03, material), Vec3::UnitZ());
    model.elements[e].damping_time = material.damping_time;
  }
  if (mass > 0.0) model.masses.push_back({elements - 1, -lever, mass, 0.0});
  finish(model);
  return model;
}

RodState settled(const RodModel& model) {
  RodState state = drawn_state(model);
  EXPECT_EQ(settle(model, state, gravity).errors, 0u);
  return state;
}

double drop(const RodModel& model) {
  return -settled(model).position.back().z();
}

// Let go from the horizontal, as measured.
double frequency(const RodModel& model) {
  const double rest = settled(model).position.back().z();
  Simulation sim(model);
  Oscillation signal;
  while (signal.crossings() < 9 && sim.state.time < 4.0) {
    signal.add(sim.state.time, sim.tip().z() - rest);
    sim.step(1.0 / 480.0, gravity);
  }
  return signal.frequency();
}

// The argument at which a function that falls (or rises) reaches a value.
template <class Function>
double solve(double low, double high, double value, const Function& function) {
  const bool rises = function(high) > function(low);
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    ((function(middle) < value) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double fitted_modulus() {
  return solve(1.0e5, 1.0e6, measured_drop[0], [](double e) { return drop(beam(e, 0.0, 0.0)); });
}

TEST(SiliconeBeam, FrequenciesWithOneModulus) {
  const double modulus = fitted_modulus();
  RecordProperty("modulus_Pa", std::to_string(modulus));
  for (int i = 0; i < 3; ++i) {
    const RodModel model = beam(modulus, tip_mass[i], 0.0);
    const double found = frequency(model);
    RecordProperty("drop_mm_" + std::to_string(i), std::to_string(1e3 * drop(model)));
    RecordProperty("frequency_Hz_" + std::to_string(i), std::to_string(found));
    EXPECT_NEAR(found / measured_frequency[i], 1.0, 0.05) << i;
  }
}

TEST(SiliconeBeam, HeightsWithTheMassesLever) {
  const double modulus = fitted_modulus();
  const double lever = solve(0.0, 0.05, measured_drop[1],
                             [&](double l) { return drop(beam(modulus, tip_mass[1], l)); });
  const double found = drop(beam(modulus, tip_mass[2], lever));
  RecordProperty("lever_m", std::to_string(lever));
  RecordProperty("drop_mm_2", std::to_string(1e3 * found));
  EXPECT_LT(lever, 0.03);  // no more than the beam is thick
  EXPECT_NEAR(found / measured_drop[2], 1.0, 0.05);
}

}  // namespace
}  // namespace pedicel::cosserat::cases
