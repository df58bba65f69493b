// Eighteen real blueberry canes, each pushed at three heights (chelsevanatter,
// ros2_ws_ROB599_Project, commit 1270e8e, BSD-3-Clause). One modulus is fitted to the heights of a
// cane, then a base that turns is added. A cantilever clamped in the ground is 3EI/h^3 stiff; a
// base that turns takes it towards k/h^2, a weaker fall with the height.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/fit/fit.h"
#include "tests/discrepancy/cane_data.h"
#include "tests/support/places.h"

namespace pedicel::discrepancy {
namespace {

using testing::CanePush;

const std::filesystem::path folder = pedicel::test::shared_folder() / "data/blueberry_canes";

FitSummary fitted(Evaluator& evaluator, const std::vector<Hypothesis>& starts, int trials) {
  FitOptions options;
  for (int t = 0; t < trials; ++t) options.trials.push_back(t);
  options.iterations = 40;
  FitSummary best;
  for (const Hypothesis& start : starts) {
    FitSummary one = fit(evaluator, start, options);
    if (best.residual.size() == 0 || one.cost < best.cost) best = std::move(one);
  }
  return best;
}

struct CaneFit {
  double modulus = 0.0;                               // Pa
  double alone = 0.0, with_base = 0.0, graded = 0.0;  // m, rms misfit
  double base = 0.0;                                  // N m/rad
  double exponent = 0.0;  // n of a measured stiffness that falls as height^-n
  double explained_by_base() const { return 1.0 - std::pow(with_base / alone, 2); }
  double explained_by_gradient() const { return 1.0 - std::pow(graded / alone, 2); }
};

double exponent_of(const std::vector<CanePush>& pushes) {
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(pushes.size());
  for (const CanePush& p : pushes) {
    mx += std::log(p.height) / n;
    my += std::log(p.stiffness) / n;
  }
  for (const CanePush& p : pushes) {
    xx += std::pow(std::log(p.height) - mx, 2);
    xy += (std::log(p.height) - mx) * (std::log(p.stiffness) - my);
  }
  return -xy / xx;
}

bool falls_with_height(std::vector<CanePush> pushes) {
  std::ranges::sort(pushes, {}, &CanePush::height);
  return std::ranges::is_sorted(pushes, std::greater<>{}, &CanePush::stiffness);
}

CaneFit fit_cane(const std::vector<CanePush>& pushes) {
  const Experiment experiment = testing::cane_experiment(pushes);
  DataSet data(experiment);
  const double std = *experiment.noise.position_std;
  data.set_noise(white_noise(std), white_noise(1.0));
  Simulator simulator(experiment, {0.05, 1.0 / 240}, 1);
  Evaluator evaluator(simulator, data);
  Hypothesis modulus;
  modulus.effects = {baseline().effects[0]};
  modulus.free = {baseline().free[0]};
  modulus.free[0].prior = 0.0;
  const int trials = static_cast<int>(experiment.trials.size());
  const FitSummary alone = fitted(evaluator, {modulus}, trials);
  const std::vector<Cause> causes = candidate_causes(experiment, scales_of(experiment));
  const auto with = [&](const std::string& name) {
    std::vector<Hypothesis> starts;
    for (const Cause& cause : causes)
      for (const Hypothesis& one : cause.starts)
        if (cause.name == name) {
          starts.push_back(alone.hypothesis);
          starts.back().add(one);
        }
    return fitted(evaluator, starts, trials);
  };
  CaneFit result;
  const auto rms = [&](const FitSummary& f) { return std * std::sqrt(2.0 * f.cost / trials); };
  const FitSummary base = with("base_compliance");
  result.alone = rms(alone);
  // The model without is the limit of both.
  result.with_base = std::min(rms(base), result.alone);
  result.graded = std::min(rms(with("stiffness_gradient")), result.alone);
  result.modulus = *experiment.plant().material.youngs_modulus * alone.hypothesis.value(0);
  result.base = base.hypothesis.value(1);
  result.exponent = exponent_of(pushes);
  return result;
}

// What a compliant base must explain where there is one: pushes made with it.
TEST(Canes, ABaseThatTurnsIsFoundInMadePushes) {
  std::vector<CanePush> pushes;
  for (const double height : {0.9, 0.8, 0.65}) {
    CanePush push;
    push.trial = static_cast<int>(pushes.size()) + 1;
    push.height = height;
    push.diameter = 0.012;
    // Straight cantilever on a spring: x/F = h^3/3EI + h^2/k.
    const double bending = 8.0e9 * M_PI / 64.0 * std::pow(0.012, 4);
    push.stiffness = 1.0 / (std::pow(height, 3) / (3.0 * bending) + height * height / 20.0);
    for (int i = 0; i < 20; ++i) {
      push.displacement.push_back(1.0e-3 * (i + 1));
      push.force.push_back(push.stiffness * push.displacement.back());
    }
    pushes.push_back(push);
  }
  const CaneFit fit = fit_cane(pushes);
  EXPECT_GT(fit.explained_by_base(), 0.99);
  // 2 % of the height is deflection: beyond the small one by (x/h)^2.
  EXPECT_NEAR(fit.base / 20.0, 1.0, 0.02);
}

TEST(Canes, WhatABaseThatTurnsExplains) {
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  std::map<std::pair<int, int>, std::vector<CanePush>> canes;
  for (CanePush& push : testing::read_cane_pushes(folder))
    canes[{push.bush, push.branch}].push_back(std::move(push));
  ASSERT_EQ(canes.size(), 18u);
  for (const auto& [name, pushes] : canes) {
    const CaneFit fit = fit_cane(pushes);
    const std::string cane =
        "cane_" + std::to_string(name.first) + "_" + std::to_string(name.second);
    RecordProperty(cane + "_exponent", std::to_string(fit.exponent));
    RecordProperty(cane + "_modulus_GPa", std::to_string(1e-9 * fit.modulus));
    RecordProperty(cane + "_misfit_mm", std::to_string(1e3 * fit.alone));
    RecordProperty(cane + "_by_base", std::to_string(fit.explained_by_base()));
    RecordProperty(cane + "_by_gradient", std::to_string(fit.explained_by_gradient()));
    // A base that turns makes the fall with the height weaker than 3, never steeper.
    if (fit.exponent > 3.5) {
      EXPECT_LT(fit.explained_by_base(), 0.1) << name.first << "." << name.second;
    }
    // One cane's stiffness does not fall with the recorded height at all: no cantilever does that.
    if (fit.exponent < 2.5 && falls_with_height(pushes)) {
      EXPECT_GT(fit.explained_by_base(), 0.5) << name.first << "." << name.second;
    }
  }
}

}  // namespace
}  // namespace pedicel::discrepancy
