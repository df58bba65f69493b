#include "plugins/discrepancy/select/evidence.h"

#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/simulate/variant_plant.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// Of an effect with sizes of more than one name (a sensor's gain and offset), those that vanish at
// zero, which the effect can do without.
std::vector<int> further_sizes(const Hypothesis& model) {
  const int last = static_cast<int>(model.effects.size()) - 1;
  std::vector<int> found;
  bool another = false;
  for (int p = 0; p < model.size(); ++p) {
    const FreeParameter& free = model.free[p];
    if (free.effect != last || free.vanishes == Vanishes::never) continue;
    const bool can_go = free.vanishes == Vanishes::at_zero && !free.logarithmic;
    another = another || !can_go || (!found.empty() && model.free[found.front()].name != free.name);
    if (can_go) found.push_back(p);
  }
  return another ? found : std::vector<int>{};
}

// Logarithm of the density at zero of some unknowns after the data over that before them.
// Savage and Dickey's ratio: it is the evidence of the model without these numbers over that with
// them, and takes no second fit. It holds where the numbers without them have the same prior, as
// here.
double density_ratio(const FitSummary& model, const Eigen::MatrixXd& information,
                     const std::vector<int>& unknowns) {
  // The covariance of all, of which the part of the asked ones is then taken: that integrates the
  // others out. The part of the information would hold them fixed.
  const Eigen::MatrixXd covariance =
      information.llt().solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  const Eigen::VectorXd u = model.hypothesis.unknowns();
  const int n = static_cast<int>(unknowns.size());
  Eigen::MatrixXd after(n, n);
  Eigen::VectorXd away(n);
  double before = 0.0;
  for (int i = 0; i < n; ++i) {
    away[i] = u[unknowns[i]];
    // A prior of this width, normal about zero, is what the number was worth before any data.
    before += 2.0 * std::log(model.hypothesis.free[unknowns[i]].width());
    for (int j = 0; j < n; ++j) after(i, j) = covariance(unknowns[i], unknowns[j]);
  }
  const Eigen::LLT<Eigen::MatrixXd> root(after);
  return 0.5 * (before - 2.0 * root.matrixLLT().diagonal().array().log().sum() -
                away.dot(root.solve(away)));
}

void sort_by_evidence(std::vector<Candidate>& candidates) {
  std::ranges::stable_sort(candidates, [](const Candidate& a, const Candidate& b) {
    // A guess from scores never stands before a fit, however good it looks.
    if (a.whole != b.whole) return a.whole;
    if (a.evidence != b.evidence) return a.evidence > b.evidence;
    // Of two that are equal, the one that is itself.
    return a.limit_of.empty() && !b.limit_of.empty();
  });
}

// Of a cause's parameter, added last; -1: it has none.
int index_of(const Hypothesis& model, const std::string& cause, const std::string& parameter) {
  for (int p = model.size() - 1; p >= 0; --p)
    if (model.free[p].name == parameter && model.effects[model.free[p].effect].name == cause)
      return p;
  return -1;
}

const std::vector<effects::Limit>& limits_of(const std::string& cause) {
  static const std::vector<effects::Limit> none;
  // The definition of an effect says what it turns into, so a new one needs no line here.
  const effects::EffectDefinition* known = effects::find_effect(cause);
  return known ? known->limits : none;
}

bool ends_at(const Candidate& candidate, const effects::Limit& limit,
             const DiagnosisSettings& settings) {
  const Hypothesis& model = candidate.fit.hypothesis;
  const int p = index_of(model, candidate.cause, limit.parameter);
  // The cause has it fixed, and a fixed number cannot have run into its limit.
  if (p < 0) return false;
  const double bound = (limit.high ? model.high() : model.low())[p];
  return std::abs(model.unknowns()[p] - bound) < settings.evidence.limit_reach;
}

// A cause that does no better where it turns into another one is no other explanation than that;
// unless that one goes on beyond the limit with a parameter that is within a deviation of it.
void find_limits(std::vector<Candidate>& candidates, const DiagnosisSettings& settings) {
  for (Candidate& candidate : candidates) candidate.limit_of.clear();
  for (Candidate& from : candidates)
    for (const effects::Limit& limit : limits_of(from.cause))
      for (const Candidate& to : candidates) {
        if (to.cause != limit.becomes || !from.whole || !to.whole ||
            !ends_at(from, limit, settings))
          continue;
        // By what the data say, and not by evidence: prices of numbers would decide between a cause
        // and its own limit.
        const double less = said_by_data(to) - said_by_data(from);
        const bool goes_on = index_of(to.fit.hypothesis, to.cause, limit.parameter) >= 0;
        // Worse without it: then it was no mere limit.
        if (less < -settings.levels.as_well || (goes_on && less < settings.levels.one_deviation))
          continue;
        from.limit_of = to.cause;
        // Never before what it turned into.
        from.evidence = std::min(from.evidence, to.evidence);
      }
}

}  // namespace

// Gains on fitted and held-out trials are both log likelihoods, and add up.
double said_by_data(const Candidate& candidate) {
  return candidate.gain + candidate.held_out.gain;
}

double least_gain_beside(const std::vector<Candidate>& found, const DiagnosisSettings& settings) {
  double strongest = 0.0;
  // A sensor's fault changes no motion, so two solvers cannot disagree about it.
  for (const Candidate& candidate : found)
    if (!is_of_sensor({candidate.cause, {}, {}, {}, {}}))
      strongest = std::max(strongest, candidate.gain);
  // Changes add up as lengths, and a gain is half a length squared: the level of a name, and what
  // two honest solvers differ by.
  const double change = std::sqrt(2.0 * settings.levels.worth_naming) +
                        settings.evidence.solvers_agree * std::sqrt(2.0 * strongest);
  return 0.5 * change * change;
}

double margin_over(const Candidate& best, const DiagnosisSettings& settings) {
  // Up to a bound: a large gain must not make a tie of everything.
  return settings.levels.clear_odds +
         std::min(settings.evidence.margin_share * best.gain, settings.evidence.most_margin);
}

double least_cost(const std::vector<Candidate>& candidates, const FitSummary& base) {
  double least = base.cost;
  // The least that any model leaves is the best that is known of the noise and of our own errors.
  for (const Candidate& candidate : candidates)
    if (candidate.whole && candidate.fit.why != "not run")
      least = std::min(least, candidate.fit.cost);
  return least;
}

double dispersion_of(const std::vector<Candidate>& candidates, const FitSummary& base,
                     int samples) {
  // Never below the noise that was measured: a model that fits too well has not made it quieter.
  return std::max(1.0, 2.0 * least_cost(candidates, base) / samples);
}

void weigh(std::vector<Candidate>& candidates, const FitSummary& base, int samples,
           double dispersion, const DiagnosisSettings& settings) {
  // The base's own numbers have a price, too, and one that a cause changes: what it makes uncertain
  // becomes cheaper. So the difference counts, not the price of the added ones.
  const double cost = cost_of_numbers(base, dispersion);
  for (Candidate& candidate : candidates) {
    if (candidate.whole) {
      candidate.gain = (base.cost - candidate.fit.cost) / dispersion;
      // A prior of one in so many for each: the more causes were tried, the easier it is that one
      // fits by chance.
      candidate.evidence = candidate.gain - (cost_of_numbers(candidate.fit, dispersion) - cost) -
                           std::log(static_cast<double>(candidates.size())) +
                           candidate.held_out.gain;
    } else {
      // Without a fit no Hessian: the price of a number is BIC's.
      const int added = candidate.fit.hypothesis.size() - base.hypothesis.size();
      candidate.evidence = candidate.gain - cost_of(added, samples, candidates.size());
    }
  }
  find_limits(candidates, settings);
  sort_by_evidence(candidates);
}

double cost_of_numbers(const FitSummary& model, double dispersion) {
  const int n = model.hypothesis.size();
  if (n == 0) return 0.0;
  Eigen::VectorXd width(n);
  double away = 0.0;
  for (int p = 0; p < n; ++p) {
    const FreeParameter& free = model.hypothesis.free[p];
    width[p] = free.width();
    if (free.prior > 0.0)
      away += std::pow(
          (free.to_unknown(model.hypothesis.value(p)) - free.to_unknown(free.prior_centre)) /
              free.prior,
          2);
  }
  // Laplace: half the logarithm of how much the data narrow the prior down.
  // In units of the prior's width each number has a prior of 1. Then the determinant of 1 + J^T J
  // is what the data narrow it down by, and no unit is left in it.
  const Eigen::MatrixXd scaled = model.jacobian * width.asDiagonal() / std::sqrt(dispersion);
  const Eigen::MatrixXd narrowed = Eigen::MatrixXd::Identity(n, n) + scaled.transpose() * scaled;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(narrowed, Eigen::EigenvaluesOnly)
          // By eigenvalues, since parameters that the data do not see must cost nothing and not
          // less.
          .eigenvalues();
  const double cost = 0.5 * (values.cwiseMax(1.0).array().log().sum() + away);
  const std::vector<int> further = further_sizes(model.hypothesis);
  if (further.empty()) return cost;
  const Eigen::VectorXd known = width.cwiseInverse();
  const Eigen::MatrixXd information = known.asDiagonal() * narrowed * known.asDiagonal();
  // Savage and Dickey: a size that could as well be zero is given back its price.
  return cost - std::max(0.0, density_ratio(model, information, further));
}

double cost_of(int parameters, int samples, std::size_t candidates) {
  // Schwarz 1978.
  return 0.5 * parameters * std::log(std::max(samples, 2)) +
         std::log(static_cast<double>(std::max<std::size_t>(candidates, 1)));
}

}  // namespace pedicel::discrepancy
