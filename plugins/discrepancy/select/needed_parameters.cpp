#include "plugins/discrepancy/select/needed_parameters.h"

#include <algorithm>

#include "plugins/discrepancy/fit/profile.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

using plant::MaterialRole;

namespace {

// At its nominal value for good.
Hypothesis without(const Hypothesis& model, int parameter) {
  Hypothesis less = model;
  // A factor of 1 is what the file says. Held there, it is no number any more, and the others make
  // up for it as far as they can.
  less.set_value(parameter, 1.0);
  less.free.erase(less.free.begin() + parameter);
  return less;
}

// Whether trials that it was not fitted to say that the nominal values are better.
bool is_refuted(Evaluator& evaluator, const NeededParameters& needed, FitOptions options,
                const std::vector<int>& check) {
  // The others keep their values: the question is about these alone.
  Hypothesis nominal = needed.model.hypothesis;
  for (const std::string& name : needed.names) nominal.set_value(nominal.factor_on(name), 1.0);
  options.trials = check;
  const std::vector<Hypothesis> models{nominal, needed.model.hypothesis};
  const Scan found = scan(evaluator, models, options);
  // Both as they are, without a refit to these trials: a refit would let the parameter explain them
  // whatever it is.
  return found.cost[1] - found.cost[0] > options.settings->levels.clear_odds;
}

// Density in place of modulus, or the other way round, so that a free swing stays as it is.
std::vector<Hypothesis> exchanged(const FitSummary& base, const FitSummary& model) {
  const int modulus = model.hypothesis.factor_on(MaterialRole::stiffness),
            density = model.hypothesis.factor_on(MaterialRole::mass);
  // Both are free, or none is: nothing to exchange.
  if ((modulus < 0) == (density < 0)) return {};
  const int needed = std::max(modulus, density);
  const std::string& other =
      effects::material_factor(modulus < 0 ? MaterialRole::stiffness : MaterialRole::mass).name;
  const int from = base.hypothesis.factor_on(other);
  if (from < 0) return {};
  Hypothesis instead = without(model.hypothesis, needed);
  // As the base had it, with its bounds and what is known of it beforehand.
  instead.free.push_back(base.hypothesis.free[from]);
  // A free swing knows only the ratio of stiffness to mass.
  instead.set_value(instead.size() - 1, 1.0 / model.hypothesis.value(needed));
  instead.name = other;
  return {instead};
}

// The modulus last: where either of two would do, it is the one that people know least.
std::vector<std::string> in_order_of_doubt() {
  std::vector<const effects::EffectDefinition*> all = effects::material_factors();
  std::stable_partition(all.begin(), all.end(), [](const effects::EffectDefinition* one) {
    return one->material->role != MaterialRole::stiffness;
  });
  std::vector<std::string> names;
  for (const effects::EffectDefinition* one : all) names.push_back(one->name);
  return names;
}

// A law in place of more of the number that it stands for, such as a law of damping in place of
// more damping time, at sizes of which one is near.
std::vector<Hypothesis> put_instead(const Cause& law, const std::string& number,
                                    const FitSummary& model) {
  const int needed = model.hypothesis.factor_on(number);
  // A law adds to what the number does; it cannot explain less.
  if (needed < 0 || model.hypothesis.value(needed) < 1.0) return {};
  std::vector<Hypothesis> starts;
  // A factor of three apart: nearer than that a fit finds its way.
  for (const double share : {0.1, 0.3, 1.0, 3.0, 10.0}) {
    starts.push_back(without(model.hypothesis, needed));
    starts.back().add(law.starts.front().shrunk(share));
    starts.back().name = law.name;
  }
  return starts;
}

}  // namespace

const FitSummary* NeededParameters::better() const {
  const auto best = std::ranges::min_element(instead, {}, &Instead::behind);
  return best != instead.end() && best->behind < 0.0 ? &best->model : nullptr;
}

NeededParameters needed_parameters(Evaluator& evaluator, const FitSummary& base,
                                   const std::vector<Cause>& causes, const FitOptions& options,
                                   const std::vector<int>& check) {
  const double deviations = options.settings->levels.needed_deviations;
  // Of a number that is off by so many deviations the cost rises by half their square.
  const double needed_cost = 0.5 * deviations * deviations;
  NeededParameters needed;
  needed.model = base;
  for (const std::string& name : in_order_of_doubt()) {
    const int p = needed.model.hypothesis.factor_on(name);
    if (p < 0) continue;
    // Refitted and not judged by standard errors: of two that do nearly the same, both have wide
    // ones, and yet one of them is needed.
    FitSummary found = fit(evaluator, without(needed.model.hypothesis, p), options);
    // Backward elimination: what can be nominal is nominal from then on.
    if (found.cost - needed.model.cost > needed_cost)
      needed.names.push_back(name);
    else
      needed.model = std::move(found);
  }
  if (!check.empty() && is_refuted(evaluator, needed, options, check)) needed.names.clear();
  const auto ask = [&](const std::vector<Hypothesis>& starts) {
    if (starts.empty()) return;
    FitSummary found = fit(evaluator, starts[scan(evaluator, starts, options).best], options);
    // With what is known beforehand: a density that must be half of what plants have explains a
    // swing, and is no explanation.
    const double behind = objective(found) - objective(needed.model);
    if (behind < options.settings->levels.clear_odds)
      needed.instead.push_back({std::move(found), behind});
  };
  // Two that are needed leave no single thing to stand for them.
  if (needed.names.size() != 1) return needed;
  ask(exchanged(base, needed.model));
  for (const Cause& cause : causes)
    if (const effects::EffectDefinition* known = effects::find_effect(cause.name);
        known && known->instead_of == needed.names.front())
      ask(put_instead(cause, needed.names.front(), needed.model));
  return needed;
}

}  // namespace pedicel::discrepancy
