#include "plugins/discrepancy/fit/baseline_start.h"

namespace pedicel::discrepancy {

namespace {

Hypothesis parameter(const std::string& name) {
  // Bounds and prior as the definition of the effect has them. A baseline that wrote its own would
  // part from what the verdict knows of the same number.
  const Hypothesis all = baseline();
  const int p = all.factor_on(name);
  Hypothesis one;
  one.effects.push_back(all.effects[p]);
  one.free.push_back(all.free[p]);
  one.free.back().effect = 0;
  return one;
}

// Those of the parameters that move a sample by so many noise units when they change by a tenth,
// beside what `base` has; the names of the others are left.
Hypothesis take_seen(Evaluator& evaluator, const FitOptions& options, const Hypothesis& base,
                     double least, std::vector<std::string>& names) {
  std::vector<Hypothesis> models{base};
  for (const std::string& name : names) {
    Hypothesis changed = parameter(name);
    // The tenth that `accuracy.seen` speaks of: so much of the parameter for so much of the noise.
    // One of them without the other says nothing.
    changed.set_value(0, 1.1);
    models.push_back(base);
    models.back().add(changed);
  }
  // All at once, side by side, so that asking costs hardly more than one simulation.
  const Eigen::MatrixXd r = evaluator.residuals(models, options);
  Hypothesis found;
  int column = 0;
  std::erase_if(names, [&](const std::string& name) {
    // The largest change of any sample, not the mean: a density is seen right after a release
    // alone, and a record with long rests would hide it in a mean.
    if ((r.col(++column) - r.col(0)).cwiseAbs().maxCoeff() < least) return false;
    found.add(parameter(name));
    return true;
  });
  return found;
}

}  // namespace

Hypothesis baseline_start(Evaluator& evaluator, const FitOptions& options,
                          std::vector<std::string>& unseen) {
  for (const plant::Effect& effect : baseline().effects) unseen.push_back(effect.name);
  const Hypothesis found =
      // What the data do not see is not fitted. It would walk about, take the modulus along, and
      // look like a finding.
      take_seen(evaluator, options, {}, options.settings->accuracy.seen, unseen);
  if (found.size() == 0) return found;
  std::vector<Hypothesis> starts;
  // Of the first that is seen, which is the modulus where that is. It sets the period, and a period
  // that is wrong puts a fit into the wrong valley. The starts are 10 to 20 % apart in frequency,
  // which goes with the root of the modulus. What the file says comes first, so that it stays where
  // another one does no better.
  for (const double factor : {1.0, 0.4, 0.55, 0.7, 0.85, 1.2, 1.5, 2.2}) {
    starts.push_back(found);
    starts.back().set_value(0, factor);
  }
  FitOptions early = options;
  // Over the first part alone: no modulus among these is out of phase there.
  early.horizon = options.settings->budget.baseline_horizon;
  return starts[scan(evaluator, starts, early).best];
}

bool add_plainly_seen(Evaluator& evaluator, const FitOptions& options,
                      std::vector<std::string>& unseen, Hypothesis& base) {
  // Nothing to look for costs no simulation.
  if (unseen.empty()) return false;
  const Hypothesis found =
      take_seen(evaluator, options, base, options.settings->accuracy.plainly_seen, unseen);
  // Behind the others, at the nominal value, so that the base fits as it did until it is fitted
  // again.
  base.add(found);
  return found.size() > 0;
}

}  // namespace pedicel::discrepancy
