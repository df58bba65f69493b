#include "plugins/discrepancy/procedure/conclusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/select/decoys.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/test/leave_one_out.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

// The effect that is found in the data before any physics: no simulation makes it.
bool is_found_in_data(const effects::EffectDefinition& one) {
  return std::holds_alternative<effects::NoChange>(one.change);
}

// The effect that says when stalks break. It is fitted to events, and by no fit of samples.
bool is_about_stalks(const effects::EffectDefinition& one) {
  return one.home == effects::Home::stalk;
}

std::string name_of(bool (*is_it)(const effects::EffectDefinition&)) {
  return std::ranges::find_if(effects::effect_definitions(), is_it)->name;
}

// How far a factor that is needed is from 1 in its deviations; 0 where our own errors may have
// moved it so far.
double deviations(const Findings& findings, const FitSummary& model, const FitSummary& base,
                  const std::string& name) {
  const int p = model.hypothesis.factor_on(name);
  // By ratio: half and twice are equally far from nominal.
  // The unknown of a factor is its logarithm, and so is the unit of its standard error.
  const double u = std::log(model.hypothesis.value(p)), error = model.standard_error[p];
  const int shifted = base.hypothesis.factor_on(name);
  const double shift = shifted >= 0 && shifted < findings.parameter_shift.size()
                           ? findings.settings->accuracy.left_uncorrected *
                                 std::abs(findings.parameter_shift[shifted])
                           : 0.0;
  const Levels& levels = findings.settings->levels;
  // Three reasons why a factor may not be at 1 although nothing is wrong add up: noise, what our
  // correction leaves, and what two honest solvers differ by.
  const bool may_be_nominal =
      std::abs(u) < levels.needed_deviations * error + shift + levels.least_factor_change;
  // Zero stands for none, since no needed factor is exactly at 1.
  return may_be_nominal ? 0.0 : u / error;
}

// What the plant file says, of the whole plant or of any of its curves.
double known_to(const Findings& findings, const std::string& name) {
  const plant::PlantFile& plant = findings.data->experiment().plant();
  const effects::EffectDefinition* known = effects::find_effect(name);
  double widest = 0.0;
  const auto look = [&](const plant::MaterialValues& material) {
    if (known && known->material)
      widest = std::max(widest, plant::stated_knowledge(material, *known->material));
  };
  // The widest that any part states: a factor is on all of them, and a curve that is hardly known
  // may explain it.
  look(plant.material);
  for (const plant::PlantCurve& curve : plant.curves) look(curve.material);
  return widest > 0.0 ? widest : findings.settings->levels.known_to;
}

bool leaves_what_is_known(const Findings& findings, const FitSummary& model,
                          const std::string& name) {
  const double factor = model.hypothesis.value(model.hypothesis.factor_on(name));
  return std::abs(factor - 1.0) > known_to(findings, name);
}

NamedCause parameter_cause(const Findings& findings, const FitSummary& model,
                           const std::string& name, double evidence) {
  const int p = model.hypothesis.factor_on(name);
  NamedCause cause;
  cause.name = name;
  // A factor and no modulus: the plant may have curves with moduli of their own, and the factor is
  // on all.
  cause.parameters["factor"] = {findings.estimate(model, p)};
  cause.evidence = evidence;
  cause.because =
      text("The refitted value is %.4g times the nominal one.", model.hypothesis.value(p));
  return cause;
}

// Likeliest first, without what loses: a law against another one by the odds of all others, the
// plain parameter only where the law is worth a name beside it.
void keep_likely(const std::string& parameter, const Levels& levels, Verdict& verdict) {
  std::ranges::stable_sort(verdict.causes, std::ranges::greater{}, &NamedCause::evidence);
  const double best = verdict.causes.front().evidence;
  std::erase_if(verdict.causes, [&](const NamedCause& other) {
    const double behind = best - other.evidence;
    // The plain parameter is the simplest thing to say, so a law must be worth a name beside it.
    // Between laws the odds of any two models count.
    const bool loses = behind > (other.name == parameter ? levels.worth_naming : levels.clear_odds);
    if (loses) verdict.competing.push_back({other.name, behind});
    return loses;
  });
  const auto lost = std::ranges::find(verdict.competing, parameter, &CompetingModel::name);
  // Told, because the reader would ask for it: a softer plant is what everybody tries first.
  if (lost != verdict.competing.end())
    verdict.causes.front().because += " Another " + parameter + " alone would explain the data " +
                                      text("%.3g nats worse.", lost->behind);
}

// Modulus, density or damping, where nothing else is wrong and 1 is far out; with the intervals of
// the fit that leaves all of them free.
void conclude_parameters(const Findings& findings, Diagnosis& diagnosis) {
  Verdict& verdict = diagnosis.verdict;
  const NeededParameters& needed = findings.needed;
  for (const std::string& name : needed.names) {
    const double off = deviations(findings, needed.model, diagnosis.base, name);
    if (off == 0.0) continue;
    // Real, and yet within what the file says of itself: then it is no error of the file.
    const bool found = leaves_what_is_known(findings, needed.model, name);
    (found ? verdict.causes : verdict.details)
        .push_back(parameter_cause(findings, diagnosis.base, name, 0.5 * off * off));
  }
  // Nothing far out: the model is as good as the data.
  // Details alone do not make a finding.
  verdict.outcome = verdict.causes.empty() ? Outcome::adequate : Outcome::named;
  // Two parameters that are off leave nothing that could stand for both.
  if (verdict.causes.size() != 1) {
    diagnosis.best = diagnosis.base;  // nothing to be better than
    return;
  }
  // Those that stand in for it are weighed against it.
  // Half the square of its deviations is what its absence would cost. `behind` is against the same
  // model, so the difference is the other one's evidence.
  const double evidence = verdict.causes.front().evidence;
  for (const auto& [instead, behind] : needed.instead) {
    const std::string& name = instead.hypothesis.name;
    diagnosis.steps.push_back(name + " in place of " + needed.names.front() +
                              text(" explains the data %.3g nats ", std::abs(behind)) +
                              (behind < 0.0 ? "better." : "worse."));
    if (instead.hypothesis.factor_on(name) >= 0) {
      verdict.causes.push_back(parameter_cause(findings, instead, name, evidence - behind));
    } else {
      Candidate other;
      other.cause = name;
      other.evidence = evidence - behind;
      const int last = static_cast<int>(instead.hypothesis.effects.size()) - 1;
      verdict.causes.push_back(findings.named(other, instead, last, verdict.fit));
    }
  }
  // Only now: all have to be there to be compared.
  keep_likely(needed.names.front(), findings.settings->levels, verdict);
  if (verdict.causes.size() > 1) verdict.outcome = Outcome::ambiguous;
}

bool is_special_case(const Candidate& special, const Candidate& general) {
  return effects::is_special_case(special.cause, general.cause);
}

// What more numbers gain by chance once in a hundred times, in nats: half a chi-squared.
double gain_by_chance(int more_numbers) {
  static constexpr std::array nats{0.0, 3.32, 4.61, 5.67, 6.64, 7.54};
  return nats[std::clamp<int>(more_numbers, 0, nats.size() - 1)];
}

int more_numbers(const Candidate& competitor, const Candidate& best) {
  return competitor.fit.hypothesis.size() - best.fit.hypothesis.size();
}

// A competing model that has the best one as a special case, and needs more parameters to do no
// better than by chance, is no other explanation: a wind of no speed is drag. Nor is one whose fit
// turned into the best one. (What would win without one of the trials does better there.)
// A general law always fits at least as well as its special case. Without this rule no special case
// could ever be named alone.
bool contains(const Candidate& competitor, const Candidate& best, bool turns) {
  // It has turned into the best one.
  if (competitor.limit_of == best.cause) return true;
  return !turns && is_special_case(best, competitor) && competitor.evidence < best.evidence &&
         said_by_data(competitor) - said_by_data(best) <=
             gain_by_chance(more_numbers(competitor, best));
}

// What a cause that has one or two more numbers explains as well, but for a nat, the data do not
// refute: fewer numbers make the other one likelier, up to so many margins. With three more (the
// offsets of a force sensor) a cause follows others.
bool explains_as_well(const Candidate& competitor, const Candidate& best, double margin,
                      const DiagnosisSettings& settings) {
  return more_numbers(competitor, best) <= settings.evidence.more_numbers &&
         said_by_data(best) - said_by_data(competitor) < settings.levels.as_well &&
         best.evidence - competitor.evidence < settings.evidence.most_margins * margin;
}

// Whether the competing model stands before the best where one of the trials is left out. Both as
// they were fitted to all: a competing model that is far off goes farther without a trial than
// first order tells. One that has the best as a special case is never behind, and ahead by what its
// numbers gain by chance.
bool wins_without_a_trial(const Findings& findings, const Candidate& competitor,
                          const Candidate& best) {
  // Of two trials one may well decide; that is no reason to doubt it.
  if (findings.fit_trials.size() < 3) return false;
  const double chance =
      is_special_case(best, competitor) ? gain_by_chance(more_numbers(competitor, best)) : 0.0;
  // To first order: the residuals of a trial stand together, so its part is taken out of both costs
  // without a refit.
  const double all = competitor.fit.cost - best.fit.cost;
  Eigen::Index row = 0;
  for (const int t : findings.fit_trials) {
    const Eigen::Index size = findings.data->size(std::span(&t, 1));
    const double here = 0.5 * (competitor.fit.residual.segment(row, size).squaredNorm() -
                               best.fit.residual.segment(row, size).squaredNorm());
    // Clearly ahead without it: then one trial alone has decided.
    // Beyond the margin: of many trials some would always turn the order by chance.
    if (all - here < -findings.settings->levels.clear_margin - chance) return true;
    row += size;
  }
  return false;
}

// Whether something is left that what was found should have explained.
void judge_remainder(const Findings& findings, Diagnosis& diagnosis) {
  Verdict& verdict = diagnosis.verdict;
  // The test after the last cause found nothing that noise does not do. Then what is left is noise,
  // however large it looks as a share.
  if (!diagnosis.after.raised) return;
  // Noise costs half a unit a sample in every model, so only what is above it can be explained.
  const double excess_before = diagnosis.base.cost - 0.5 * findings.samples();
  const double excess_after = diagnosis.best.cost - 0.5 * findings.samples();
  const double left = excess_after / std::max(excess_before, 1.0);
  verdict.remainder =
      text("%.2g %% of what the refitted model left above the noise", 100.0 * std::max(left, 0.0));
  // Everything that was found together, since the remainder is what all of it leaves.
  double gain = 0.0;
  // A loss on held-out trials is judged by itself, and does not make what is left more important.
  for (const Candidate& found : findings.chain)
    gain += found.gain + std::max(0.0, found.held_out.gain);
  // What the strongest direction would still gain, or a cause of what none looks for.
  const ResidualPower& other = diagnosis.after.residual_power;
  const double missed =
      0.5 *
      std::pow(std::max(diagnosis.after.statistic, other.shows() ? other.deviations : 0.0), 2);
  const Levels& levels = findings.settings->levels;
  // Both as a share and in noise: a large share of little is no finding, nor is a little beside
  // much.
  const bool much =
      left > levels.remainder_share && findings.excess(diagnosis.best) > levels.small_excess;
  // Little is left, and no direction would gain much of it: the cause was right, and its model is a
  // little off.
  if (!much && missed <= levels.missed_share * gain) {
    // As little as noise alone leaves is nothing that is left.
    if (left <= 0.0) verdict.remainder.clear();
    return;
  }
  verdict.outcome = Outcome::unknown;
  verdict.remainder = "known causes leave " + verdict.remainder;
}

// Those that the data cannot tell from the best are causes, too; the others are competing models.
void weigh_competing_models(const Findings& findings, Diagnosis& diagnosis, int base_effects) {
  Verdict& verdict = diagnosis.verdict;
  const Candidate& best = diagnosis.ranking.front();
  const DiagnosisSettings& settings = *findings.settings;
  const double margin = margin_over(best, settings);
  for (std::size_t i = 1; i < diagnosis.ranking.size(); ++i) {
    const Candidate& competitor = diagnosis.ranking[i];
    const double behind = best.evidence - competitor.evidence;
    // In order: what follows was not fitted, or explains less than nothing.
    // Sorted: whole fits first, by evidence.
    if (!competitor.whole || competitor.evidence < 0.0) break;
    const bool turns = wins_without_a_trial(findings, competitor, best);
    const bool beaten =
        behind > margin && !explains_as_well(competitor, best, margin, settings) && !turns;
    diagnosis.steps.push_back(text("Of %.4g nats that a competing model must lose by, ", margin) +
                              competitor.cause +
                              text(" loses by %.4g; the data say %.4g less for it, and it has",
                                   behind, said_by_data(best) - said_by_data(competitor)) +
                              text(" %g more numbers", more_numbers(competitor, best)) +
                              (turns ? "; one trial alone decides between them." : "."));
    // Beside several causes a competing model has to be fitted with the others:
    // weigh_substitutes().
    if (beaten || findings.chain.size() > 1 || contains(competitor, best, turns)) {
      // What is named is not its own competitor.
      const bool found = std::ranges::any_of(
          findings.chain, [&](const Candidate& named) { return named.cause == competitor.cause; });
      if (!found) verdict.competing.push_back({competitor.cause, behind});
      continue;
    }
    verdict.causes.push_back(findings.named(competitor, competitor.fit, base_effects, verdict.fit));
    verdict.outcome = Outcome::ambiguous;
  }
}

// Of several causes, those that others could stand in for: the data say that something is there,
// and not which.
void weigh_substitutes(const Findings& findings, Diagnosis& diagnosis, int base_effects) {
  if (findings.chain.size() < 2) return;
  Verdict& verdict = diagnosis.verdict;
  for (const Findings::Substitute& other : findings.substitutes) {
    if (other.link >= findings.chain.size()) continue;
    const Candidate& own = findings.chain[other.link];
    if (other.behind > margin_over(own, *findings.settings) ||
        contains(other.candidate, own, false))
      continue;
    const int effect = base_effects + static_cast<int>(other.link);
    NamedCause cause = findings.named(other.candidate, other.candidate.fit, effect, verdict.fit);
    cause.instead_of = own.cause;
    std::erase_if(verdict.competing,
                  [&](const CompetingModel& model) { return model.name == cause.name; });
    verdict.causes.push_back(std::move(cause));
    verdict.outcome = Outcome::ambiguous;
  }
}

// The first cause must gain more than the same change backwards in time or at other markers.
void show_decoys(const Findings& findings, Diagnosis& diagnosis) {
  const Eigen::VectorXd& without = diagnosis.base.residual;
  // The first alone: its change is the difference of two fits to the same samples.
  const Eigen::VectorXd& with = findings.chain.front().fit.residual;
  // Fitted to other trials, or not at all: nothing to compare.
  if (without.size() != with.size() || with.size() == 0) return;
  const Decoys decoys =
      decoys_of(*findings.data, findings.fit_trials, without, Eigen::VectorXd(without - with),
                findings.settings->evidence.too_alike);
  Verdict& verdict = diagnosis.verdict;
  // Told in any case: how much better a cause is than nonsense of its own size.
  verdict.causes.front().because +=
      text(" Decoys of it gain less: %.3g nats backwards in time, %.3g at other markers,",
           decoys.reversed, decoys.exchanged) +
      text(" of %.3g.", decoys.own);
  // A cause must gain by its shape, not by its size: a decoy has the same size.
  if (decoys.lose(findings.settings->levels.clear_margin)) return;
  verdict.outcome = Outcome::unknown;
  verdict.remainder =
      "the same change backwards in time, or at other markers, explains the data as well";
}

// By how much the trials disagree about the numbers of the first cause.
void show_trials_left_out(const Findings& findings, NamedCause& cause) {
  const FitSummary& fit = findings.chain.front().fit;
  if (findings.fit_trials.size() < 2 ||
      fit.jacobian.rows() != findings.data->size(findings.fit_trials))
    return;
  std::vector<Eigen::Index> rows;
  // To first order (Cook 1977): refitting without each trial would take as long as the search.
  for (const int t : findings.fit_trials) rows.push_back(findings.data->size(std::span(&t, 1)));
  double most = 0.0;
  for (const LeftOut& without : leave_one_out(fit, rows))
    for (int p = 0; p < fit.hypothesis.size(); ++p)
      if (fit.hypothesis.effects[fit.hypothesis.free[p].effect].name == cause.name &&
          fit.standard_error[p] > 0.0)
        most = std::max(most, std::abs(without.moved[p]) / fit.standard_error[p]);
  cause.because +=
      text(" Without any one of the trials its numbers move by %.2g deviations at most.", most);
}

void conclude_causes(const Findings& findings, Diagnosis& diagnosis) {
  Verdict& verdict = diagnosis.verdict;
  const int base_effects = static_cast<int>(diagnosis.base.hypothesis.effects.size());
  for (std::size_t c = 0; c < findings.chain.size(); ++c)
    verdict.causes.push_back(findings.named(findings.chain[c], diagnosis.best,
                                            base_effects + static_cast<int>(c), verdict.fit));
  // The order matters: competing models first, since what is left and the decoys take the name away
  // from all of them.
  verdict.outcome = Outcome::named;
  // Each of these may only lower the verdict: named, then ambiguous, then unknown.
  weigh_competing_models(findings, diagnosis, base_effects);
  weigh_substitutes(findings, diagnosis, base_effects);
  judge_remainder(findings, diagnosis);
  show_decoys(findings, diagnosis);
  show_trials_left_out(findings, verdict.causes.front());
  // What does nothing for trials that it was not fitted to is no cause. The first of several was
  // judged while the others were missing there.
  // With all causes where there are several: trials held out show all of them at once.
  const HeldOut& held_out =
      findings.chain.size() > 1 ? findings.held_out : findings.chain.front().held_out;
  if (verdict.outcome == Outcome::named && !held_out.carries_over(findings.settings->evidence)) {
    verdict.outcome = Outcome::unknown;
    verdict.remainder = "what was fitted does not carry over to the held-out trials";
  }
}

// The residual's own scatter, over the noise: of an RMS over as many samples.
double scatter(const Findings& findings, const std::vector<int>& trials) {
  // The mean square of n normal numbers has the variance 2 / n, and its root half of that
  // deviation.
  return interval95 / std::sqrt(2.0 * std::max(1, findings.data->samples(trials)));
}

}  // namespace

bool knows_parameters(const Findings& findings, const FitSummary& model) {
  constexpr double certain = 3.0;  // deviations
  return std::ranges::all_of(Shift::names(), [&](const std::string& name) {
    const int p = model.hypothesis.factor_on(name);
    if (p < 0) return true;
    const double u = std::log(model.hypothesis.value(p));
    return std::abs(u) + certain * findings.spread(model) * model.standard_error[p] <
           std::log1p(known_to(findings, name));
  });
}

std::vector<NamedCause> parameters_off(const Findings& findings, const NeededParameters& needed,
                                       const FitSummary& best) {
  std::vector<NamedCause> causes;
  for (const std::string& name : needed.names) {
    const double off = deviations(findings, needed.model, best, name);
    if (off != 0.0 && leaves_what_is_known(findings, needed.model, name))
      causes.push_back(parameter_cause(findings, needed.model, name, 0.5 * off * off));
  }
  return causes;
}

void measure_errors(const Findings& findings, Diagnosis& diagnosis) {
  const auto measure = [&](const std::vector<int>& trials, Errors& errors) {
    if (trials.empty()) return;
    const auto over = [&](Model model) {
      return findings.data->rms(trials, diagnosis.predictions[model]);
    };
    errors = {over(nominal), over(refitted), over(extended)};
  };
  measure(diagnosis.fit_trials, diagnosis.verdict.fit);
  measure(diagnosis.check_trials, diagnosis.verdict.check);
  const Errors& check = diagnosis.verdict.check;
  // Without something above the noise to gain, a gain would divide by nothing.
  if (!check.refitted) return;
  // Chance moves the error of some hundred samples by 5 %.
  diagnosis.verdict.refit_misleads =
      *check.refitted > findings.settings->levels.held_out_worse * *check.nominal;
  const double noise = scatter(findings, diagnosis.check_trials);
  const auto gain_over = [&](double error) -> std::optional<double> {
    if (error - 1.0 <= noise) return {};
    return (error - *check.extended) / (error - 1.0);
  };
  if (!findings.chain.empty()) diagnosis.verdict.gain = gain_over(*check.refitted);
  diagnosis.verdict.gain_over_nominal = gain_over(*check.nominal);
}

void conclude(const Findings& findings, Diagnosis& diagnosis) {
  Verdict& verdict = diagnosis.verdict;
  // No alarm and no cause: all that may be off is in the numbers of the plain model.
  if (!diagnosis.before.raised && findings.chain.empty()) {
    conclude_parameters(findings, diagnosis);
  } else if (findings.chain.empty() && !diagnosis.before.residual_power.shows() &&
             findings.excess(diagnosis.base) < findings.settings->levels.small_excess) {
    conclude_parameters(findings, diagnosis);
    verdict.remainder = text(
        "a steady difference of %.3g noise units in all, which no cause explains and no single "
        "sample shows",
        diagnosis.before.statistic);
  } else if (findings.chain.empty()) {
    verdict.outcome = Outcome::unknown;
    const ResidualPower& left = diagnosis.before.residual_power;
    if (left.shows())
      verdict.remainder =
          "the plant moves in its own shapes in " +
          (left.in_all ? "all trials"
                       : "trial " + diagnosis.admission.experiment.trials[left.trial].name) +
          left.frequency() + text(", %.3g deviations beyond noise", left.deviations) +
          ", and no cause explains it";
  } else {
    conclude_causes(findings, diagnosis);
  }
}

void name_nothing(Verdict& verdict) {
  std::string names;
  for (const NamedCause& cause : verdict.causes)
    names += (names.empty() ? "" : " with ") + cause.name;
  // Moved and not left: what stands under `causes` is believed, also by scripts.
  verdict.nearest = std::move(verdict.causes);
  verdict.causes.clear();
  verdict.details.clear();
  for (NamedCause& cause : verdict.nearest) cause.against = verdict.remainder;
  if (!names.empty()) verdict.remainder += "; the nearest known cause is " + names;
  verdict.gain = verdict.gain_over_nominal = {};
}

void conclude_outliers(Diagnosis& diagnosis) {
  const Admission& admission = diagnosis.admission;
  const Levels& levels = diagnosis.settings.levels;
  // As a number and as a share: a short record has a few by chance, and a swing that starts within
  // a sample makes some.
  if (admission.outliers <
      std::max<double>(levels.outlier_count, levels.outlier_share * admission.points))
    return;
  Verdict& verdict = diagnosis.verdict;
  // Among competing models, or where nothing is known, they would read as one more explanation.
  if (verdict.outcome != Outcome::adequate && verdict.outcome != Outcome::named) return;
  NamedCause cause;
  cause.name = name_of(is_found_in_data);
  const double count = admission.outliers, fraction = admission.outlier_fraction();
  const double error = interval95 * std::sqrt(count) / admission.points;
  cause.parameters["fraction"] = {
      {fraction, std::max(0.0, fraction - error), fraction + error, "1"}};
  cause.because = std::to_string(admission.outliers) +
                  " samples stand far from their neighbours, each by itself; they were left out.";
  // Each lies 10 deviations out: as Gaussian noise it would cost 50 nats.
  cause.evidence = 50.0 * count;
  verdict.causes.push_back(cause);
  verdict.outcome = Outcome::named;
}

void conclude_detachment(Diagnosis& diagnosis) {
  const StalkStrength& strength = diagnosis.strength;
  if (!strength.needs_law()) return;
  Verdict& verdict = diagnosis.verdict;
  const std::string sentence = strength.sentence();
  // The law rests on loads of a model that does not explain the data: it is said, and not named.
  if (verdict.outcome != Outcome::adequate && verdict.outcome != Outcome::named) {
    verdict.remainder += (verdict.remainder.empty() ? "" : ". ") + sentence;
    return;
  }
  NamedCause cause;
  cause.name = name_of(is_about_stalks);
  plant::Effect effect;
  effect.name = cause.name;
  const BreakLaw& law = strength.law->law;
  for (int i = stalk_force; i < stalk_load_count; ++i) {
    const double scale = law.scale[i];
    if (!std::isfinite(scale)) continue;
    const double factor = std::exp(interval95 * strength.law->error[i]);
    const std::string name(stalk_limits[i].name), unit(stalk_limits[i].unit);
    cause.parameters[name] = {{scale, scale / factor, scale * factor, unit}};
    effect.numbers[name] = {scale};
  }
  const Estimate exponent{law.exponent, law.exponent, law.exponent, "1"};
  cause.parameters["exponents"] = {exponent, exponent, exponent};
  effect.numbers["exponents"] = {law.exponent, law.exponent, law.exponent};
  cause.because = sentence;
  cause.evidence = strength.evidence;
  verdict.causes.push_back(cause);
  verdict.outcome = Outcome::named;
  // Without free numbers, since it was fitted to events and not to samples. So the extended plant
  // has it, and the fit's unknowns stay as they are.
  diagnosis.best.hypothesis.effects.push_back(effect);
}

void report_parameters(const Findings& findings, Diagnosis& diagnosis) {
  const FitSummary& fit = diagnosis.best;
  const plant::MaterialValues& material = diagnosis.admission.experiment.plant().material;
  for (int p = 0; p < fit.hypothesis.size(); ++p) {
    const FreeParameter& free = fit.hypothesis.free[p];
    const std::string& effect = fit.hypothesis.effects[free.effect].name;
    const effects::EffectDefinition* known = effects::find_effect(effect);
    // Curves with moduli of their own have no single value to tell.
    const auto own =
        known && known->material ? plant::number_of(material, *known->material) : std::nullopt;
    if (!own) continue;
    Estimate estimate = findings.estimate(fit, p);
    for (double* x : {&estimate.value, &estimate.low, &estimate.high}) *x *= *own;
    estimate.unit = known->material->unit;
    diagnosis.verdict.parameters[effect] = estimate;
  }
}

void report_detectable_limits(const std::vector<Cause>& causes, Diagnosis& diagnosis) {
  // Beside something that nobody knows, larger than any of them, all of them could hide.
  if (diagnosis.verdict.outcome == Outcome::unknown) return;
  for (const Cause& cause : causes) {
    DetectableLimit least;
    least.name = cause.name;
    double best = 0.0;
    for (const Direction& direction : diagnosis.directions) {
      if (direction.cause != cause.name) continue;
      // The start that says most: the strongest, and of thresholds the highest that is seen.
      const double size = length(direction);
      // The level that noise reaches, and what our own error may add to it: below that nothing is
      // seen.
      const double seen = diagnosis.before.level + std::abs(direction.systematic);
      // A start of a linear cause is better the more it changes. Of a threshold the weakest start
      // that is still seen is the limit itself.
      const double worth = !direction.has_threshold ? size : size < seen ? 0.0 : 1.0 / size;
      if (worth < best) continue;
      best = worth;
      least.smallest = detectable_limit(direction, seen, least.parameter);
    }
    least.unit = effects::unit_of(cause.name, least.parameter);
    diagnosis.verdict.detectable_limits.push_back(least);
  }
}

}  // namespace pedicel::discrepancy
