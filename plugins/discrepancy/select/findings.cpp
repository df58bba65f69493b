#include "pedicel/discrepancy/select/findings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pedicel/discrepancy/data/sentence.h"
#include "pedicel/discrepancy/fit/numerics.h"
#include "pedicel/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

Estimate Findings::estimate(const FitSummary& fit, int parameter) const {
  const FreeParameter& free = fit.hypothesis.free[parameter];
  const double u = free.to_unknown(fit.hypothesis.value(parameter));
  // In the unknown, so that the interval of a factor is one by ratio and stays above zero.
  double error = interval95 * fit.standard_error[parameter] * spread(fit);
  if (parameter < parameter_shift.size())
    error += settings->accuracy.left_uncorrected * std::abs(parameter_shift[parameter]);
  Estimate estimate{free.to_value(u), free.to_value(u - error), free.to_value(u + error),
                    free.unit};
  if (effects::is_time(fit.hypothesis.effects[free.effect].name, free.name)) {
    // A moment anywhere in a step is even over it: its deviation is the step over root 12.
    const double least = interval95 * step / std::sqrt(12.0);
    estimate.low = estimate.value - std::hypot(estimate.value - estimate.low, least);
    estimate.high = estimate.value + std::hypot(estimate.high - estimate.value, least);
  }
  return estimate;
}

// Where more than noise is left, intervals are wider.
double Findings::spread(const FitSummary& fit) const {
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
  if (known && known->home == effects::Home::base)
    cause.where = root_place(data->experiment().plant);
  cause.words = effect.words;
  for (int p = 0; p < fit.hypothesis.size(); ++p) {
    const FreeParameter& free = fit.hypothesis.free[p];
    // The place is told as `where`.
    if (free.effect != first_effect || free.name == "at") continue;
    cause.parameters[free.name].push_back(estimate(fit, p));
  }
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
  const auto found = std::ranges::find_if(symptoms, is_about);
  std::string sentence = found == symptoms.end() ? "" : found->sentence + " ";
  return sentence + "With " + effects::plain_name(cause) +
         text(" the residual falls from %.3g to %.3g times the noise",
              errors.refitted.value_or(0.0), errors.extended.value_or(0.0)) +
         " in the fitted trials.";
}

plant::CurvePlace root_place(const plant::PlantFile& plant) {
  plant::CurvePlace nearest;
  double least = std::numeric_limits<double>::infinity();
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
