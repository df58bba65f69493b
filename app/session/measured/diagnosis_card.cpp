#include "app/session/measured/diagnosis_card.h"

#include <algorithm>

#include "plugins/discrepancy/report/report_words.h"
#include "plugins/discrepancy/report/scene_report.h"
#include "plugins/discrepancy/test/symptom_parts.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::app {

namespace {

using discrepancy::Outcome;

constexpr std::size_t most_competing = 5;

std::string next_step(const discrepancy::Verdict& verdict) {
  if (!verdict.next_experiment.empty()) return verdict.next_experiment;
  switch (verdict.outcome) {
    case Outcome::bad_data:
      return "Mend the data: " + verdict.remainder + ".";
    case Outcome::numerical:
      return "Fewer or shorter trials, or a plant drawn without very short pieces, would let the "
             "mesh and the step become finer.";
    case Outcome::adequate:
      return "Nothing is missing at this noise: the refitted parameters will do.";
    case Outcome::unknown:
      return "Repeat the trial with the largest residual at half and at twice its amplitude, with "
             "one more marker where the residual is largest.";
    default:
      return "No further experiment is needed for this: accept the extended plant.";
  }
}

DiagnosisCard::Cause cause_of(const discrepancy::NamedCause& cause) {
  std::string numbers;
  for (const auto& [name, estimates] : cause.parameters)
    numbers += (numbers.empty() ? "" : "; ") + name + " " + discrepancy::estimate_text(estimates);
  const std::string place = discrepancy::place_text(cause);
  return {effects::plain_name(cause.name) + " (" + cause.name + ")",
          place.empty() ? "the whole" : place, numbers, cause.because, cause.evidence};
}

std::vector<DiagnosisCard::CompetingModel> competing_models_of(
    const discrepancy::Diagnosis& diagnosis) {
  std::vector<DiagnosisCard::CompetingModel> models;
  const auto& causes = diagnosis.verdict.causes;
  for (const discrepancy::Candidate& candidate : diagnosis.ranking) {
    const bool named = std::ranges::any_of(
        causes, [&](const auto& cause) { return cause.name == candidate.cause; });
    if (named || models.size() == most_competing) continue;
    models.push_back({candidate.cause, discrepancy::why_it_lost(candidate, diagnosis),
                      diagnosis.ranking.front().evidence - candidate.evidence});
  }
  return models;
}

std::vector<DiagnosisCard::CompetingModel> competing_models_of(
    const discrepancy::SceneDiagnosis& diagnosis) {
  std::vector<DiagnosisCard::CompetingModel> models;
  const auto& candidates = diagnosis.findings.candidates;
  // The first is the one that is told.
  for (std::size_t i = 1; i < candidates.size() && models.size() < most_competing; ++i)
    models.push_back({discrepancy::joined_names(candidates[i].names),
                      discrepancy::short_number(candidates[i].excess) +
                          " noise units are left with it, " +
                          discrepancy::short_number(candidates.front().excess) + " with the best",
                      candidates[i].cost - candidates.front().cost});
  return models;
}

/// What both kinds of diagnosis say alike.
DiagnosisCard card_of(const discrepancy::Verdict& verdict) {
  DiagnosisCard card;
  card.good = verdict.outcome == Outcome::adequate || verdict.outcome == Outcome::named;
  card.outcome = to_string(verdict.outcome);
  card.headline = headline(verdict);
  if (verdict.outcome == Outcome::bad_data || verdict.outcome == Outcome::numerical) return card;
  card.remainder = discrepancy::remainder_text(verdict);
  for (const auto& cause : verdict.causes) card.causes.push_back(cause_of(cause));
  std::tie(card.detectable_limits, card.unseen) = discrepancy::detectable_limit_texts(verdict);
  return card;
}

}  // namespace

DiagnosisCard card_of(const discrepancy::Diagnosis& diagnosis) {
  const discrepancy::Verdict& verdict = diagnosis.verdict;
  DiagnosisCard card = card_of(verdict);
  card.certainty = discrepancy::certainty_text(diagnosis);
  card.next = next_step(verdict);
  if (verdict.outcome == Outcome::bad_data || verdict.outcome == Outcome::numerical) return card;
  card.gain = discrepancy::gain_text(diagnosis);
  card.competing_models = competing_models_of(diagnosis);
  return card;
}

DiagnosisCard card_of(const discrepancy::SceneDiagnosis& diagnosis) {
  DiagnosisCard card = card_of(diagnosis.verdict);
  card.certainty = discrepancy::scene_certainty_text(diagnosis);
  card.gain = discrepancy::scene_gain_text(diagnosis);
  card.competing_models = competing_models_of(diagnosis);
  card.next = discrepancy::scene_next_text(diagnosis.verdict);
  return card;
}

}  // namespace pedicel::app
