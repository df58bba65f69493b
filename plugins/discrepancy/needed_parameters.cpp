#include "discrepancy/needed_parameters.h"

#include <algorithm>

namespace pedicel::discrepancy {

namespace {

// Nats: 3.5 standard deviations, because three parameters share the few false alarms allowed.
constexpr double least_cost = 0.5 * 3.5 * 3.5;

}  // namespace

std::vector<std::string> needed_parameters(Evaluator& evaluator, const FitSummary& base,
                                           const FitOptions& options) {
  std::vector<std::string> needed;
  FitSummary model = base;
  for (const char* name : {"density", "damping_time", "youngs_modulus"}) {
    const int p = model.hypothesis.factor_on(name);
    if (p < 0) continue;
    Hypothesis without = model.hypothesis;
    without.set_value(p, 1.0);
    without.free.erase(without.free.begin() + p);
    FitSummary found = fit(evaluator, without, options);
    if (found.cost - model.cost > least_cost)
      needed.push_back(name);
    else
      model = std::move(found);
  }
  return needed;
}

}  // namespace pedicel::discrepancy
