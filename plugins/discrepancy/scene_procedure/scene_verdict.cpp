#include "pedicel/discrepancy/scene_procedure/scene_verdict.h"

#include <algorithm>
#include <cmath>

#include "pedicel/io/csv.h"

namespace pedicel::discrepancy {

namespace {

constexpr double ninety_five = 1.96;

Estimate estimate_of(const SceneFitResult& fit, int p) {
  const effects::FreeParameter& free = fit.model.free[static_cast<std::size_t>(p)];
  const double u = free.to_unknown(fit.model.value(p)), error = ninety_five * fit.standard_error[p];
  return {fit.model.value(p), free.to_value(u - error), free.to_value(u + error), free.unit};
}

NamedCause cause_of(const SceneFitResult& fit, const std::string& name, const SceneFindings& found,
                    double evidence) {
  NamedCause cause;
  cause.name = name;
  cause.evidence = evidence;
  for (int p = 0; p < fit.model.size(); ++p) {
    const effects::FreeParameter& free = fit.model.free[static_cast<std::size_t>(p)];
    const plant::Effect& effect = fit.model.effects[static_cast<std::size_t>(free.effect)];
    if (effect.name != name) continue;
    cause.parameters[free.name].push_back(estimate_of(fit, p));
    cause.words = effect.words;
  }
  const SceneEffectDefinition* known = find_scene_effect(name);
  const std::string left = io::format_number(SceneDataSet::beyond_noise(fit.sum), 3);
  cause.because = (known ? known->sentence : name + " differs from the file") +
                  ": with it the misfit beyond the noise falls from " +
                  io::format_number(found.baseline_excess, 3) + " to " + left + " noise units";
  return cause;
}

double rms_over_noise(double excess) {
  return std::sqrt(1.0 + excess * excess);
}

}  // namespace

Verdict verdict_of(const SceneFindings& found, const SceneExperiment&) {
  Verdict verdict;
  using Of = SceneFindings::Outcome;
  verdict.outcome = found.outcome == Of::adequate    ? Outcome::adequate
                    : found.outcome == Of::named     ? Outcome::named
                    : found.outcome == Of::ambiguous ? Outcome::ambiguous
                                                     : Outcome::unknown;
  verdict.partial = found.partial;
  verdict.fit.nominal = rms_over_noise(found.nominal_excess);
  verdict.fit.refitted = rms_over_noise(found.baseline_excess);
  const bool explains = found.outcome == Of::named || found.outcome == Of::ambiguous;
  const SceneFitResult& model =
      explains && !found.candidates.empty() ? found.candidates.front().fit : found.baseline;
  for (const char* name : {"youngs_modulus", "density", "damping_time"})
    if (const int p = model.model.factor_on(name); p >= 0)
      verdict.parameters[std::string(name) + "_factor"] = estimate_of(model, p);
  if (!found.candidates.empty()) {
    const SceneCandidate& best = found.candidates.front();
    if (explains) verdict.fit.extended = rms_over_noise(best.excess);
    for (const SceneCandidate& one : found.candidates) {
      const double evidence = 0.5 * found.baseline.sum.square - one.cost;
      std::string all;
      for (const std::string& name : one.names) all += (all.empty() ? "" : " + ") + name;
      const double behind = one.cost - best.cost;
      if (&one == &best && explains)
        for (const std::string& name : one.names)
          verdict.causes.push_back(cause_of(one.fit, name, found, evidence));
      else if (found.outcome == Of::ambiguous && one.names.size() == 1 &&
               behind < 0.05 * evidence + 3.0)
        verdict.causes.push_back(cause_of(one.fit, one.names.front(), found, evidence));
      else if (found.outcome == Of::unknown && verdict.nearest.size() < 3)
        verdict.nearest.push_back(cause_of(one.fit, one.names.back(), found, evidence));
      if (&one != &best) verdict.competing.push_back({all, behind});
    }
  }
  for (const std::string& name : found.material)
    verdict.causes.push_back(cause_of(model, name, found, 0.0));
  // A material's number alone is a finding, too.
  if (verdict.outcome == Outcome::adequate && !verdict.causes.empty())
    verdict.outcome = Outcome::named;
  if (verdict.outcome == Outcome::unknown)
    verdict.remainder = io::format_number(found.baseline_excess, 3) +
                        " noise units are left beyond the noise, and no known cause explains them";
  if (verdict.outcome == Outcome::ambiguous)
    for (const NamedCause& cause : verdict.causes)
      if (const SceneEffectDefinition* known = find_scene_effect(cause.name))
        verdict.next_experiment +=
            (verdict.next_experiment.empty() ? "" : "; or ") + known->tells_apart;
  return verdict;
}

std::string scene_headline(const Verdict& verdict) {
  std::string names;
  for (const NamedCause& cause : verdict.causes) {
    const SceneEffectDefinition* known = find_scene_effect(cause.name);
    names += (names.empty() ? "" : ", ") +
             (known ? known->plain_name : effects::plain_name(cause.name)) + " (" + cause.name +
             ")";
    for (const auto& [parameter, estimates] : cause.parameters) {
      std::string values;
      for (const Estimate& estimate : estimates)
        values += (values.empty() ? "" : ", ") + io::format_number(estimate.value, 3);
      names += " " + parameter + " " + (estimates.size() > 1 ? "[" + values + "]" : values);
      if (estimates.front().unit != "1") names += " " + estimates.front().unit;
    }
  }
  switch (verdict.outcome) {
    case Outcome::adequate:
      return "The scene's model is adequate: nothing beyond what two solvers differ by.";
    case Outcome::named:
      return "The data show " + names + ".";
    case Outcome::ambiguous:
      return "The data cannot tell apart: " + names + ".";
    default:
      return "Something is there that no known cause explains: " + verdict.remainder + ".";
  }
}

}  // namespace pedicel::discrepancy
