// Gravity stiffening of a steel strip, 0.52 m x 0.08 m x 1 mm, E 190 GPa, 7,870 kg/m3: its first
// bending frequency about the thin axis is 2.81 Hz upright, 2.94 Hz level, 3.06 Hz hanging.
//
// Small vibrations of a beam with the axial force N(s):  EI w'''' - (N w')' = rho A omega^2 w,
// N = +-rho A g (L - s), + where it hangs. "Level" has no axial gravity (N = 0): here the strip
// stands on edge, gravity along its 80 mm, so that it hardly sags; its weight then also twists the
// bent strip, which lowers the frequency by about (q / q_cr)^2 / 2 ~ 0.1 % with the lateral
// buckling load q_cr = 12.85 sqrt(EI GJ) / L^3 (Timoshenko & Gere, Theory of Elastic Stability,
// section 6.4).
//
// Reference: Rayleigh-Ritz with w = x^2 ... x^9, x = s / L, whose integrals are exact; the
// frequency is then exact to eight digits.
// Discretisation: 24 segments -0.08 %, BDF2 at 1/480 s -(omega dt)^2 / 3 = -0.05 %.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "plugins/cosserat/solver/standing.h"
#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double length = 0.52, width = 0.08, thickness = 0.001;
const Material steel{190.0e9, 0.3, 7870.0, 0.0};

// Hz; `axial` = +1 hanging, 0 level, -1 upright.
double reference(double axial) {
  constexpr int terms = 8;
  const double bending = steel.youngs_modulus * width * thickness * thickness * thickness / 12.0;
  const double mass = steel.density * width * thickness;
  Eigen::MatrixXd stiffness(terms, terms), inertia(terms, terms);
  for (int a = 0; a < terms; ++a) {
    for (int b = 0; b < terms; ++b) {
      const double i = a + 2, j = b + 2;
      const double bent = i * (i - 1) * j * (j - 1) / (i + j - 3);        // of w'' w''
      const double pulled = i * j * (1.0 / (i + j - 1) - 1.0 / (i + j));  // of (1 - x) w' w'
      stiffness(a, b) = bending / std::pow(length, 3) * bent + axial * mass * 9.81 * pulled;
      inertia(a, b) = mass * length / (i + j + 1);
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, inertia);
  return std::sqrt(solver.eigenvalues()[0]) / (2.0 * pi);
}

double simulated(const Vec3& along) {
  const Vec3 side = Vec3::UnitY();  // the strip's normal: it swings sideways to gravity
  RodModel model =
      straight_rod(length, 24, rectangle_section(thickness, width, steel), along, side);
  stand_as_drawn(model, gravity);
  Simulation sim(model, settings_with(Integrator::bdf2));
  const CantileverMode mode(1, length);
  set_mode_shape(sim.model, sim.state, mode, 1.0e-4, side);
  Oscillation signal;
  while (signal.crossings() < 11 && sim.state.time < 10.0) {
    signal.add(sim.state.time, modal_amplitude(sim.model, sim.state, mode, side));
    sim.step(1.0 / 480.0, gravity);
  }
  return signal.frequency();
}

struct Case {
  const char* name;
  Vec3 along;
  double axial, published;
};

TEST(RodStrip, GravityStiffening) {
  for (const Case& c :
       {Case{"upright", Vec3::UnitZ(), -1.0, 2.81}, Case{"level", Vec3::UnitX(), 0.0, 2.94},
        Case{"hanging", -Vec3::UnitZ(), 1.0, 3.06}}) {
    const double expected = reference(c.axial), found = simulated(c.along);
    RecordProperty(c.name, std::to_string(found));
    EXPECT_NEAR(expected, c.published, 0.006)
        << c.name;  // half of the last digit given, rounded up
    EXPECT_NEAR(found / expected, 1.0, 0.005) << c.name;
    EXPECT_NEAR(found / c.published, 1.0, 0.01) << c.name;
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
