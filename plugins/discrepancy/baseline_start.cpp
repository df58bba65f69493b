#include "discrepancy/baseline_start.h"

namespace pedicel::discrepancy {

namespace {

constexpr double first_horizon = 0.3;  // share of the records in which periods do not slip

// Parameters that move nothing by a tenth of the noise when they change by a tenth are left out.
Hypothesis seen_baseline(Evaluator& evaluator, const FitOptions& options,
                         std::vector<std::string>& unseen) {
  const Hypothesis all = baseline();
  std::vector<Hypothesis> models{all};
  for (int p = 0; p < all.size(); ++p) {
    models.push_back(all);
    models.back().set_value(p, 1.1);
  }
  const Eigen::MatrixXd r = evaluator.residuals(models, options);
  Hypothesis seen;
  for (int p = 0; p < all.size(); ++p) {
    if ((r.col(p + 1) - r.col(0)).cwiseAbs().maxCoeff() < 0.1) {
      unseen.push_back(all.effects[p].name);
      continue;
    }
    Hypothesis one;
    one.effects.push_back(all.effects[p]);
    one.free.push_back(all.free[p]);
    one.free.back().effect = 0;
    seen.add(one);
  }
  return seen;
}

}  // namespace

Hypothesis baseline_start(Evaluator& evaluator, const FitOptions& options,
                          std::vector<std::string>& unseen) {
  const Hypothesis seen = seen_baseline(evaluator, options, unseen);
  if (seen.size() == 0) return seen;
  std::vector<Hypothesis> starts;
  for (const double factor : {1.0, 0.4, 0.55, 0.7, 0.85, 1.2, 1.5, 2.2}) {
    starts.push_back(seen);
    starts.back().set_value(0, factor);
  }
  FitOptions early = options;
  early.horizon = first_horizon;
  return starts[scan(evaluator, starts, early).best];
}

}  // namespace pedicel::discrepancy
