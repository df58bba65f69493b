#include "plugins/discrepancy/procedure/shares.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/discrepancy/procedure/conclusion.h"
#include "plugins/discrepancy/select/left_misfit.h"
#include "plugins/discrepancy/select/symptom_numbers.h"
#include "plugins/discrepancy/simulate/channel.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

/// What stands for one cause of the verdict.
struct Explained {
  NamedCause* cause = nullptr;
  Hypothesis with, without;
};

// The model with a parameter at its nominal value, or without the effect; nothing where it has
// neither.
// Taken out and not set to nothing: the numbers of an effect that does nothing are open, and a
// refit would run off along them.
std::optional<Hypothesis> less(const Hypothesis& model, const std::string& cause) {
  Hypothesis rest = model;
  if (const int p = model.factor_on(cause); p >= 0) {
    rest.set_value(p, 1.0);
    rest.free.erase(rest.free.begin() + p);
    return rest;
  }
  // The last of that name is the one that was added last.
  const auto found =
      std::ranges::find(model.effects.rbegin(), model.effects.rend(), cause, &plant::Effect::name);
  if (found == model.effects.rend()) return {};
  const int effect = static_cast<int>(std::distance(found, model.effects.rend())) - 1;
  rest.effects.erase(rest.effects.begin() + effect);
  std::erase_if(rest.free, [&](const FreeParameter& free) { return free.effect == effect; });
  // Free numbers know their effect by its place in the list, which has moved.
  for (FreeParameter& free : rest.free) free.effect -= free.effect > effect ? 1 : 0;
  return rest;
}

// Modulus, density and damping that are no causes do not stand in for the cause that is taken out.
void hold_what_is_no_cause(const std::vector<NamedCause>& causes, Hypothesis& model) {
  for (const std::string& name : Shift::names()) {
    const int p = model.factor_on(name);
    // Free, a modulus would take up what a weak segment did, and the segment's share would be
    // nearly nothing.
    if (p >= 0 && std::ranges::find(causes, name, &NamedCause::name) == causes.end())
      model.free.erase(model.free.begin() + p);
  }
}

// The others stay what they are: where they are, and at half to twice their size. A weak stretch
// that may grow along the whole stem would be the modulus by another name.
void keep_what_others_are(Hypothesis& model) {
  // Sizes may adapt, since causes overlap: held fixed, each share would count the overlap, and
  // their sum would be above 1.
  const Hypothesis half = model.shrunk(0.5), twice = model.shrunk(2.0);
  for (int p = model.size() - 1; p >= 0; --p) {
    FreeParameter& free = model.free[p];
    // Our own error is no cause, and is free to be whatever it is in each of the models.
    if (model.effects[free.effect].name == mesh_error) continue;
    const double a = half.value(p), b = twice.value(p);
    // Places, times and shapes stay: moved, they would make of a cause another one.
    if (free.vanishes == Vanishes::never || a == b) {
      model.free.erase(model.free.begin() + p);
      continue;
    }
    free.low = std::max(free.low, std::min(a, b));
    free.high = std::min(free.high, std::max(a, b));
  }
}

Hypothesis refitted_to(Evaluator& evaluator, const Hypothesis& start, const FitOptions& options) {
  return start.size() > 0 ? fit(evaluator, start, options).hypothesis : start;
}

const FitSummary* alternative(const Findings& findings, const Diagnosis& diagnosis,
                              const std::string& cause) {
  // A cause that competes is in no common model. Its share is taken in its own fit, beside what is
  // certain where it is one of several.
  for (const Findings::Substitute& other : findings.substitutes)
    if (other.candidate.cause == cause) return &other.candidate.fit;
  for (const Candidate& candidate : diagnosis.ranking)
    if (candidate.cause == cause) return &candidate.fit;
  for (const NeededParameters::Instead& other : findings.needed.instead)
    if (other.model.hypothesis.name == cause) return &other.model;
  return nullptr;
}

/// Shares over some trials.
class SharedMisfit {
 public:
  SharedMisfit(Evaluator& evaluator, const FitOptions& options, std::vector<int> trials)
      : evaluator_(evaluator), options_(options) {
    options_.trials = std::move(trials);
    if (options_.trials.empty()) return;
    // J of the nominal model less what noise alone would be. So the share of all causes together is
    // 1 where they leave noise.
    above_noise_ = above_noise(of(Hypothesis{}), evaluator_.data().samples(options_.trials));
  }
  std::optional<double> share(const Explained& explained) {
    // A share of nothing is no number.
    if (!above_noise_) return {};
    return (of(explained.without) - of(explained.with)) / *above_noise_;
  }

 private:
  double of(const Hypothesis& model) {
    return evaluator_.residuals(std::span(&model, 1), options_).squaredNorm();
  }

  Evaluator& evaluator_;
  FitOptions options_;
  std::optional<double> above_noise_;
};

/// Sum of squares of what was measured three numbers at a time.
class VectorRms {
 public:
  void add(const Eigen::MatrixXd& measured, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    // Markers, forces and moments are vectors. Their size does not depend on how the axes are laid.
    const Eigen::Index columns = std::min({measured.cols(), a.cols(), b.cols()});
    for (Eigen::Index c = 0; c + 2 < columns; c += 3)
      for (Eigen::Index i = 0; i < measured.rows(); ++i) {
        // Of the axes that were measured.
        const auto seen = measured.block<1, 3>(i, c).array().isFinite();
        // An axis that was not measured counts as no change: the number is of what a reader can
        // find in the data.
        const double far =
            seen.select(a.block<1, 3>(i, c) - b.block<1, 3>(i, c), 0.0).squaredNorm();
        if (!seen.any() || !std::isfinite(far)) continue;
        sum_ += far;
        ++count_;
      }
  }
  std::optional<double> value() const {
    return count_ > 0 ? std::optional(std::sqrt(sum_ / count_)) : std::nullopt;
  }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

Change change_of(Evaluator& evaluator, const Explained& explained, FitOptions options) {
  const Experiment& experiment = evaluator.data().experiment();
  options.trials.resize(experiment.trials.size());
  // All trials, held out ones as well. Nothing is fitted here.
  for (int t = 0; t < static_cast<int>(options.trials.size()); ++t) options.trials[t] = t;
  const std::vector<Hypothesis> models{explained.with, explained.without};
  const auto predicted = evaluator.predictions(models, options);
  VectorRms markers, force, moment;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const Trial& trial = experiment.trials[t];
    const Prediction &with = predicted[0][t], &without = predicted[1][t];
    markers.add(trial.markers.value, with.markers, without.markers);
    force.add(trial.force.value, with.force, without.force);
    if (trial.wrench.size() == 0) continue;
    force.add(trial.wrench.value.leftCols(3), with.wrench.leftCols(3), without.wrench.leftCols(3));
    moment.add(trial.wrench.value.rightCols(3), with.wrench.rightCols(3),
               without.wrench.rightCols(3));
  }
  // A force of the hand and one at the root are one kind: both are what an instrument reads in N.
  return {markers.value(), force.value(), moment.value()};
}

double most(const NamedCause& cause) {
  // What shows in either kind of trial is no detail. Below any share where there is none.
  return std::max(cause.share.fit.value_or(-1.0), cause.share.check.value_or(-1.0));
}

// What explains most comes first; what has no share (a law of breaking) stays behind.
void sort_by_share(std::vector<NamedCause>& causes) {
  std::ranges::stable_sort(causes, std::ranges::greater{}, most);
}

// Beside what explains most, a small thing is no cause.
void set_details_apart(const Levels& levels, Verdict& verdict) {
  // The first stays whatever its share: a verdict that is named names something.
  const auto first = verdict.causes.begin() + 1;
  const auto small = std::stable_partition(first, verdict.causes.end(), [&](const NamedCause& c) {
    return most(c) >= levels.least_share || !c.share.fit;
  });
  verdict.details.insert(verdict.details.end(), std::make_move_iterator(small),
                         std::make_move_iterator(verdict.causes.end()));
  verdict.causes.erase(small, verdict.causes.end());
}

// Causes that exclude each other stand beside parameters that are off. Where these explain nearly
// all, they are the finding.
void settle_ambiguity(const Levels& levels, std::vector<NamedCause>& parameters, Verdict& verdict) {
  sort_by_share(parameters);
  const double best = std::ranges::max(verdict.causes, {}, most).share.fit.value_or(1.0);
  // The data cannot tell which of the causes it is, and none of them matters beside a modulus that
  // is off.
  if (!parameters.empty() && best < levels.least_share && most(parameters.front()) > best) {
    std::swap(parameters, verdict.causes);
    verdict.outcome = Outcome::named;
  }
  std::ranges::move(parameters, std::back_inserter(verdict.details));
}

// Of causes that act together some are certain. Where those that are not are too small to matter,
// they are details, and what is certain is named.
bool settle_substitutes(const Levels& levels, Verdict& verdict) {
  const auto group = [](const NamedCause& cause) {
    return cause.instead_of.empty() ? cause.name : cause.instead_of;
  };
  std::vector<std::string> open, large;
  for (const NamedCause& cause : verdict.causes)
    if (!cause.instead_of.empty()) open.push_back(cause.instead_of);
  if (open.empty()) return false;
  for (const NamedCause& cause : verdict.causes)
    if (most(cause) >= levels.least_share) large.push_back(group(cause));
  const auto stays = [&](const NamedCause& cause) {
    return std::ranges::count(open, group(cause)) == 0 ||
           std::ranges::count(large, group(cause)) > 0;
  };
  const auto small = std::stable_partition(verdict.causes.begin(), verdict.causes.end(), stays);
  // Something must be left to be named.
  if (small == verdict.causes.begin()) return false;
  for (auto cause = small; cause != verdict.causes.end(); ++cause)
    verdict.details.push_back(std::move(*cause));
  verdict.causes.erase(small, verdict.causes.end());
  const bool is_open = std::ranges::any_of(
      verdict.causes, [](const NamedCause& cause) { return !cause.instead_of.empty(); });
  if (!is_open) verdict.outcome = Outcome::named;
  return !is_open;
}

// Adds the residuals of a trial.
void add_misfit(const DataSet& data, int trial, const Prediction& base, const Prediction& told,
                InstrumentSums& sums) {
  constexpr std::array names{"position", "force", "moment"};  // by ChannelKind
  const int size = data.size(std::span(&trial, 1));
  Eigen::VectorXd white_base(size), white_told(size);
  data.residual(trial, base, 1.0, white_base);
  data.residual(trial, told, 1.0, white_told);
  const Eigen::MatrixXd plain = data.scaled_residual(trial, told);
  Eigen::Index row = 0;
  for (int c = 0; c < plain.cols(); ++c) {
    const ChannelPlace channel = channel_at(data.experiment(), trial, c);
    const Eigen::Index rows = channel.samples->size();
    const auto seen = plain.col(c).array().isFinite();
    sums[names[static_cast<std::size_t>(channel.kind)]] +=
        {white_base.segment(row, rows).squaredNorm(), white_told.segment(row, rows).squaredNorm(),
         seen.select(plain.col(c), 0.0).squaredNorm(), static_cast<double>(seen.count())};
    row += rows;
  }
}

}  // namespace

void tell_left(const Findings& findings, Diagnosis& diagnosis) {
  const DataSet& data = *findings.data;
  // A model whose name was taken back is not told.
  const std::vector<Prediction>& told =
      diagnosis.predictions[diagnosis.verdict.causes.empty() ? refitted : extended];
  const auto over = [&](const std::vector<int>& trials) {
    InstrumentSums sums;
    for (const int t : trials)
      add_misfit(data, t, diagnosis.predictions[refitted][t], told[t], sums);
    return sums;
  };
  LeftMisfit& left = diagnosis.verdict.left;
  left = left_misfit(over(diagnosis.fit_trials), over(diagnosis.check_trials));
  left.symptoms = names_that_show(symptom_numbers(symptoms(data.experiment(), data, told)));
}

void tell_shares(Evaluator& evaluator, const Findings& findings, const FitOptions& options,
                 Diagnosis& diagnosis) {
  Verdict& verdict = diagnosis.verdict;
  const bool is_ambiguous = verdict.outcome == Outcome::ambiguous;
  // Under `unknown` nothing is believed, and shares of what is not believed would be read as
  // findings.
  if (verdict.causes.empty() || (verdict.outcome != Outcome::named && !is_ambiguous)) return;
  const Levels& levels = findings.settings->levels;

  NeededParameters needed = findings.needed;
  std::vector<NamedCause> parameters;
  if (!findings.chain.empty()) {
    // The noise was read anew since the best model was fitted.
    // Else its cost would be in the old noise units, and a parameter would seem needed that is not.
    const FitSummary best = refit(evaluator, diagnosis.best, options);
    // Where all are what the file says, none is asked for by refits without it.
    if (knows_parameters(findings, best)) {
      needed = {{}, best, {}};
    } else {
      needed = needed_parameters(evaluator, best, {}, options);
      parameters = parameters_off(findings, needed, best);
    }
    // Beside causes of which one is right they wait: settle_ambiguity() says on which side they
    // stand.
    if (!is_ambiguous) std::ranges::move(parameters, std::back_inserter(verdict.causes));
  }

  // Names only are looked at. A copy, because the causes get their shares while the list is read.
  std::vector<NamedCause> others = verdict.causes;
  std::ranges::copy(parameters, std::back_inserter(others));
  std::vector<Explained> all;
  const auto explain = [&](NamedCause& cause) {
    const FitSummary* model = &needed.model;
    // First in the model with all causes, where one is taken out and the others stay.
    std::optional<Hypothesis> rest = less(model->hypothesis, cause.name);
    if (!rest) {
      model = alternative(findings, diagnosis, cause.name);
      if (model) rest = less(model->hypothesis, cause.name);
    }
    if (!rest) return;
    hold_what_is_no_cause(others, *rest);
    keep_what_others_are(*rest);
    all.push_back({&cause, model->hypothesis, refitted_to(evaluator, *rest, options)});
  };
  std::ranges::for_each(verdict.causes, explain);
  if (is_ambiguous) std::ranges::for_each(parameters, explain);

  SharedMisfit fitted(evaluator, options, diagnosis.fit_trials);
  // Refits above saw the fitted trials only, so this share is honest.
  SharedMisfit held_out(evaluator, options, diagnosis.check_trials);
  // Only now may the list be sorted: until here each entry points into it.
  for (const Explained& one : all) {
    one.cause->share = {fitted.share(one), held_out.share(one)};
    one.cause->change = change_of(evaluator, one, options);
  }
  if (is_ambiguous && !settle_substitutes(levels, verdict)) {
    settle_ambiguity(levels, parameters, verdict);
  } else {
    // Parameters that waited stand with what is named after all.
    if (is_ambiguous) std::ranges::move(parameters, std::back_inserter(verdict.causes));
    sort_by_share(verdict.causes);
    set_details_apart(levels, verdict);
  }
}

}  // namespace pedicel::discrepancy
