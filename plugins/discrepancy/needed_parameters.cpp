#include "discrepancy/needed_parameters.h"

#include <algorithm>

#include "discrepancy/profile.h"

namespace pedicel::discrepancy {

namespace {

// Nats: 3.5 standard deviations, because three parameters share the few false alarms allowed.
constexpr double least_cost = 0.5 * 3.5 * 3.5;
constexpr double clear_margin = 5.0;  // nats by which the other one must be worse

// At its nominal value for good.
Hypothesis without(const Hypothesis& model, int parameter) {
  Hypothesis less = model;
  less.set_value(parameter, 1.0);
  less.free.erase(less.free.begin() + parameter);
  return less;
}

// The one in place of the other, so that a free swing stays as it is.
std::optional<FitSummary> exchanged(Evaluator& evaluator, const FitSummary& base,
                                    const FitSummary& model, const FitOptions& options) {
  const int modulus = model.hypothesis.factor_on("youngs_modulus"),
            density = model.hypothesis.factor_on("density");
  if ((modulus < 0) == (density < 0)) return {};
  const int needed = std::max(modulus, density);
  const char* other = modulus < 0 ? "youngs_modulus" : "density";
  const int from = base.hypothesis.factor_on(other);
  if (from < 0) return {};
  Hypothesis instead = without(model.hypothesis, needed);
  instead.free.push_back(base.hypothesis.free[from]);
  instead.set_value(instead.size() - 1, 1.0 / model.hypothesis.value(needed));
  FitSummary found = fit(evaluator, instead, options);
  if (objective(found) - objective(model) > clear_margin) return {};
  return found;
}

}  // namespace

NeededParameters needed_parameters(Evaluator& evaluator, const FitSummary& base,
                                   const FitOptions& options) {
  NeededParameters needed;
  needed.model = base;
  for (const char* name : {"density", "damping_time", "youngs_modulus"}) {
    const int p = needed.model.hypothesis.factor_on(name);
    if (p < 0) continue;
    FitSummary found = fit(evaluator, without(needed.model.hypothesis, p), options);
    if (found.cost - needed.model.cost > least_cost)
      needed.names.push_back(name);
    else
      needed.model = std::move(found);
  }
  needed.exchanged = exchanged(evaluator, base, needed.model, options);
  return needed;
}

}  // namespace pedicel::discrepancy
