#include "plugins/discrepancy/select/findings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/data/sentence.h"
#include "plugins/discrepancy/fit/numerics.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

Estimate Findings::estimate(const FitSummary& fit, int parameter) const {
  const FreeParameter& free = fit.hypothesis.free[parameter];
  const double u = free.to_unknown(fit.hypothesis.value(parameter));
  // In the unknown, so that the interval of a factor is one by ratio and stays above zero.
  // A fit's standard error is for noise of the size that was measured. Where more is left, the same
  // curvature stands for a wider likelihood.
  double error = interval95 * fit.standard_error[parameter] * spread(fit);
  // Only the base's numbers have such a shift, and they stand first among the unknowns. It is added
  // and not squared: our own error is the same in every repetition.
  if (parameter < parameter_shift.size())
    error += settings->accuracy.left_uncorrected * std::abs(parameter_shift[parameter]);
  Estimate estimate{free.to_value(u), free.to_value(u - error), free.to_value(u + error),
                    free.unit};
  if (effects::is_time(fit.hypothesis.effects[free.effect].name, free.name)) {
    // A moment anywhere in a step is even over it: its deviation is the step over root 12.
    // However precise the data are, they were fitted by a simulator that knows moments to a step.
    const double least = interval95 * step / std::sqrt(12.0);
    estimate.low = estimate.value - std::hypot(estimate.value - estimate.low, least);
    estimate.high = estimate.value + std::hypot(estimate.high - estimate.value, least);
  }
  return estimate;
}

// Where more than noise is left, intervals are wider.
double Findings::spread(const FitSummary& fit) const {
  // Never below 1: a fit that leaves less than the noise by chance has not made the noise smaller.
  return std::sqrt(std::max(1.0, 2.0 * fit.cost / std::max(1, samples())));
}

double Findings::excess(const FitSummary& model) const {
  // One is the noise itself.
  return 2.0 * model.cost / std::max(1, samples()) - 1.0;
}

NamedCause Findings::named(const Candidate& candidate, const FitSummary& fit, int first_effect,
                           const Errors& errors) const {
  NamedCause cause;
  cause.name = candidate.cause;
  cause.evidence = candidate.evidence;
  const plant::Effect& effect = fit.hypothesis.effects[first_effect];
  cause.where = effect.place;
  const effects::EffectDefinition* known = effects::find_effect(cause.name);
  // What sits at the root has no place of its own in the model, but readers look for one.
  if (known && known->home == effects::Home::base)
    cause.where = root_place(data->experiment().plant());
  cause.words = effect.words;
  for (int p = 0; p < fit.hypothesis.size(); ++p) {
    const FreeParameter& free = fit.hypothesis.free[p];
    // The place is told as `where`.
    // Effects that were found before this one are entries of their own.
    if (free.effect != first_effect || free.name == "at") continue;
    cause.parameters[free.name].push_back(estimate(fit, p));
  }
  // Without an interval, both ends at the value: it was chosen and not found.
  for (const auto& [name, numbers] : effect.numbers)
    // What was not free is told, too, as what it was held at.
    if (!cause.parameters.contains(name))
      for (const double x : numbers)
        cause.parameters[name].push_back({x, x, x, effects::unit_of(cause.name, name)});
  cause.because = because(cause.name, errors);
  return cause;
}

// What is seen without the cause and gone with it.
std::string Findings::because(const std::string& cause, const Errors& errors) const {
  const auto is_about = [&](const Symptom& symptom) {
    return symptom.shows() &&
           std::ranges::find(symptom.speaks_for, cause) != symptom.speaks_for.end();
  };
  // The clearest one, of whichever kind. Of two that are equally clear the first: symptoms stand in
  // the order of their finders, those at rest first, which are the easiest to check by eye.
  const Symptom* clearest = nullptr;
  for (const Symptom& symptom : symptoms)
    if (is_about(symptom) && (!clearest || symptom.significance() > clearest->significance()))
      clearest = &symptom;
  const std::string sentence = clearest ? clearest->sentence + " " : "";
  return sentence + "With " + effects::plain_name(cause) +
         text(" the residual falls from %.3g to %.3g times the noise",
              errors.refitted.value_or(0.0), errors.extended.value_or(0.0)) +
         " in the fitted trials.";
}

plant::CurvePlace root_place(const plant::PlantFile& plant) {
  plant::CurvePlace nearest;
  double least = std::numeric_limits<double>::infinity();
  // Either end: a curve may be drawn towards the root.
  for (const plant::PlantCurve& curve : plant.curves)
    for (const double at : {0.0, 1.0}) {
      const Vec3& end = at == 0.0 ? curve.points.front() : curve.points.back();
      if ((end - plant.root).norm() >= least) continue;
      least = (end - plant.root).norm();
      nearest = {curve.name, at, {}};
    }
  return nearest;
}

}  // namespace pedicel::discrepancy
