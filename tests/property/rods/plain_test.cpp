// The plain solver itself: its forces are the slope of its potential, its ways to solve agree, and
// what the gardens' check measures sees an error.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/property/rods/plain_step.h"
#include "tests/property/rods/random_garden.h"

namespace pedicel::plain {
namespace {

// Small plants of every kind, at the first guess of a step of second order.
struct Case {
  Garden garden;
  Garden::Plant plant;
  cosserat::RodState before;
  Step step;
  Place place;

  Case(const Garden& drawn, const Garden::Plant& one)
      : garden(drawn),
        plant(one),
        before(one.start),
        step(plant.model, plant.start, &before, garden.dt, garden.gravity, plant.loads),
        place(step.first_guess()) {}
};

template <class Judge>
void for_each_case(int seeds, const Judge& judge) {
  for (int seed = 1; seed <= seeds; ++seed) {
    const Garden garden = draw_garden(seed, 30);
    for (std::size_t p = 0; p < garden.plants.size() && p < 3; ++p) {
      SCOPED_TRACE(describe(garden));
      judge(Case(garden, garden.plants[p]));
    }
  }
}

Six unit(int i) {
  return Six::Unit(i);
}

// Central differences; what an energy of double precision leaves of a slope is small beside the
// largest forces of its terms, which the roots of the diagonal stand for.
TEST(PlainStep, ForcesAreTheSlopeOfThePotential) {
  for_each_case(60, [](const Case& one) {
    const System system = one.step.linearise(one.place);
    std::vector<Six> nothing(one.place.position.size(), Six::Zero());
    for (int e = 0; e < one.plant.model.size(); ++e) {
      if (!one.plant.start.alive[e]) continue;
      for (int i = 0; i < 6; ++i) {
        // A change of energy by 1e-6 of its scale.
        const double by = 1.0e-6 * (i < 3 ? one.plant.model.elements[e].length : 1.0);
        std::vector<Six> change = nothing;
        change[e] = by * unit(i);
        const double slope = (one.step.potential(moved(one.place, change), one.place) -
                              one.step.potential(moved(one.place, change, -1.0), one.place)) /
                             (2.0 * by);
        const double energy = std::abs(one.step.potential(one.place, one.place));
        const double allowed = 1.0e-14 * energy / by + 1.0e-3 * by * system.diagonal[e](i, i) +
                               1.0e-7 * std::abs(slope);
        EXPECT_NEAR(system.right[e][i], -slope, 10.0 * allowed) << "element " << e << ", " << i;
      }
    }
  });
}

TEST(PlainSystem, ThreeWaysToSolveAgree) {
  for_each_case(60, [](const Case& one) {
    const System system = one.step.linearise(one.place);
    if (one.plant.model.size() == 0) return;
    const auto plain = solve(system), sparse = solve_sparse(system), dense = solve_dense(system);
    ASSERT_TRUE(plain && sparse && dense);
    for (const auto& found : {*plain, *sparse, *dense}) {
      std::vector<Six> errors;
      for (const Six& x : found) errors.push_back(1.0e-14 * x.cwiseAbs());
      const auto left = residual(system, found), bound = residual_bound(system, errors);
      for (std::size_t e = 0; e < left.size(); ++e)
        for (int i = 0; i < 6; ++i)
          EXPECT_LE(std::abs(left[e][i]), bound[e][i] + 1.0e-300) << "element " << e;
    }
  });
}

TEST(PlainStep, ItsMinimumIsOne) {
  int found = 0;
  for_each_case(40, [&](const Case& one) {
    const auto place = minimise(one.step, one.place, 1.0e-7);
    if (!place) return;
    ++found;
    EXPECT_LE(one.step.potential(*place, *place),
              one.step.potential(one.place, *place) * (1.0 + 1.0e-12) + 1.0e-12);
  });
  EXPECT_GT(found, 30);
}

}  // namespace
}  // namespace pedicel::plain
