// Buckling, from the signs of the eigenvalues of the exact Hessian (a straight column never buckles
// by itself, it needs an imperfection or this test).
//
// Euler: a column clamped below and free above buckles at P = pi^2 EI / (4 L^2).
// Greenhill (Proc. Cambridge Phil. Soc. 4, 1881): under its own weight it stands up to
// L^3 = 7.8373 EI / (rho g A); 7.8373 = (9/4) j^2 with j = 1.86635 the first zero of J_{-1/3}.
// With n segments and half a segment's compliance at the clamp the load is too low by O(1/n^2):
// about (pi / (4 n))^2 / 3 ~ 1e-3 with 20, so 3 % leaves room, and 0.5 % is what is asked here.
#include <gtest/gtest.h>

#include "plugins/cosserat/solver/standing.h"
#include "tests/analytic/rod_cases.h"

namespace pedicel::cosserat::cases {
namespace {

constexpr double tolerance = 0.005;
constexpr int elements = 20;

RodModel column(double length) {
  return straight_rod(length, elements,
                      circle_section(PeerCantilever::radius, PeerCantilever::material()),
                      Vec3::UnitZ());
}

// The largest value that is stable, by bisection; `low` is stable, `high` is not.
template <class Stable>
double critical(double low, double high, const Stable& stable) {
  EXPECT_TRUE(stable(low));
  EXPECT_FALSE(stable(high));
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return low;
}

TEST(RodBuckling, EulerLoadOfAClampedFreeColumn) {
  const double length = 0.4;
  const RodModel model = column(length);
  const double euler = pi * pi * PeerCantilever::bending / (4.0 * length * length);
  const double found = critical(0.5 * euler, 2.0 * euler, [&](double force) {
    Load load;
    load.element = elements - 1;
    load.force_W = Vec3(0, 0, -force);
    RodState state = drawn_state(model);
    settle(model, state, no_gravity, {&load, 1});  // pressed, and straight
    return is_stable(model, state, no_gravity, {&load, 1});
  });
  RecordProperty("relative_error", std::to_string(found / euler - 1.0));
  EXPECT_NEAR(found / euler, 1.0, tolerance);
}

TEST(RodBuckling, GreenhillLength) {
  const double greenhill =
      std::cbrt(7.8373 * PeerCantilever::bending / (PeerCantilever::mass_per_length * 9.81));
  const double found = critical(0.5 * greenhill, 2.0 * greenhill, [](double length) {
    RodModel model = column(length);
    stand_as_drawn(model, gravity);
    return is_stable(model, drawn_state(model), gravity);
  });
  RecordProperty("relative_error", std::to_string(found / greenhill - 1.0));
  EXPECT_NEAR(found / greenhill, 1.0, tolerance);
}

// The test above asks the Hessian; this one lets the column move. Pushed by a millionth of its
// length, it comes back below the Greenhill length and falls beyond it.
TEST(RodBuckling, AColumnBeyondGreenhillFallsAtATouch) {
  const double greenhill =
      std::cbrt(7.8373 * PeerCantilever::bending / (PeerCantilever::mass_per_length * 9.81));
  for (const double share : {0.9, 1.1}) {
    RodModel model = column(share * greenhill);
    for (Element& element : model.elements) element.damping_time = 0.05;
    stand_as_drawn(model, gravity);
    Simulation sim(model);
    sim.loads.push_back({elements - 1, 0.0, Vec3(1e-6, 0, 0), no_gravity});
    for (int i = 0; i < 240; ++i) sim.step(1.0 / 240.0, gravity);
    sim.loads.clear();
    for (int i = 0; i < 9 * 240; ++i) sim.step(1.0 / 240.0, gravity);
    const double lean = std::abs(sim.tip().x()) / greenhill;
    if (share < 1.0)
      EXPECT_LT(lean, 1e-4);
    else
      EXPECT_GT(lean, 0.1);
  }
}

}  // namespace
}  // namespace pedicel::cosserat::cases
