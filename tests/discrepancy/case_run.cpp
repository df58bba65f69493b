#include "tests/discrepancy/case_run.h"

#include <algorithm>
#include <cmath>

#include "engine/io/atomic_file.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/select/evidence.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::hidden {

namespace {

using discrepancy::Diagnosis;

// Sum of squares over the noise, and the number of samples, of what was measured and kept.
void add_squares(const Eigen::MatrixXd& measured, const Eigen::MatrixXd& clean, double std,
                 double& sum, int& count) {
  for (Eigen::Index i = 0; i < measured.size(); ++i) {
    if (!std::isfinite(measured(i))) continue;
    sum += std::pow((measured(i) - clean(i)) / std, 2);
    ++count;
  }
}

TrueError true_error(const HiddenCase& hidden, const Diagnosis& diagnosis) {
  TrueError truth;
  double sum = 0.0;
  for (const int t : diagnosis.check_trials) {
    const discrepancy::Trial& trial = diagnosis.admission.experiment.trials[t];
    const reference::Record& clean = hidden.clean[t];
    add_squares(trial.markers.value, clean.markers, diagnosis.position_noise.std, sum,
                truth.samples);
    if (trial.force.size() > 0)
      add_squares(trial.force.value, clean.force, diagnosis.force_noise.std, sum, truth.samples);
    if (trial.wrench.size() == 0) continue;
    const Noise& noise = hidden.noise;
    add_squares(trial.wrench.value.leftCols(3), clean.wrench.leftCols(3), noise.force_std, sum,
                truth.samples);
    add_squares(trial.wrench.value.rightCols(3), clean.wrench.rightCols(3), noise.moment_std, sum,
                truth.samples);
  }
  if (truth.samples > 0) truth.error = std::sqrt(sum / truth.samples);
  return truth;
}

// Where one parameter was needed, or what may stand for it, and no candidate was refitted.
std::optional<double> lead_among(const discrepancy::Verdict& verdict, const std::string& name) {
  using discrepancy::NamedCause;
  const auto truth = std::ranges::find(verdict.causes, name, &NamedCause::name);
  if (verdict.outcome != discrepancy::Outcome::ambiguous || truth == verdict.causes.end())
    return {};
  std::optional<double> lead;
  for (const NamedCause& other : verdict.causes) {
    const double here = truth->evidence - other.evidence;
    if (other.name != name) lead = std::min(lead.value_or(here), here);
  }
  return lead;
}

// Score::lead. A cause that has the truth as a special case, or turned into it, is no other one.
std::optional<double> lead_of(const HiddenCase& hidden, const Diagnosis& diagnosis) {
  using discrepancy::Candidate;
  if (hidden.order.kind != CaseOrder::Kind::effect) return {};
  const std::string& name = hidden.causes.front().name;
  const auto truth = std::ranges::find_if(
      diagnosis.ranking, [&](const Candidate& c) { return c.whole && c.cause == name; });
  if (truth == diagnosis.ranking.end()) return lead_among(diagnosis.verdict, name);
  std::optional<double> lead;
  for (const Candidate& other : diagnosis.ranking) {
    if (!other.whole || other.cause == name || other.limit_of == name ||
        effects::is_special_case(name, other.cause))
      continue;
    const double here = discrepancy::said_by_data(*truth) - discrepancy::said_by_data(other);
    lead = std::min(lead.value_or(here), here);
  }
  return lead;
}

// Where and of what kind the force is that was found in place of a known cause.
void score_force(const HiddenCase& hidden, const discrepancy::MissingForce& force, Score& score) {
  score.force_kind = force.kind;
  score.other_kinds = force.other_kinds;
  if (hidden.outside.empty() || !force.place) return;
  const plant::CurvePlace& truth = hidden.outside.front().place;
  if (truth.curve == force.place->curve) score.force_away = std::abs(truth.at - force.place->at);
  if (force.place_error > 0.0) score.force_error = force.place_error;
  score.force_elsewhere = std::ranges::any_of(
      force.elsewhere, [&](const plant::CurvePlace& p) { return p.curve == truth.curve; });
}

std::string notes_of(const CaseRun& run, const Diagnosis& diagnosis) {
  std::string text = truth_text(run.hidden) + "\n";
  for (const std::string& step : diagnosis.steps) text += step + "\n";
  text += "\nRanking (evidence; gain; over the whole):\n";
  for (const discrepancy::Candidate& candidate : diagnosis.ranking)
    text += "  " + candidate.cause + ": " + std::to_string(candidate.evidence) + "; " +
            std::to_string(candidate.gain) + (candidate.whole ? "; yes\n" : "; no\n");
  return text + "\n" + discrepancy::to_json(run.verdict) + "\n\n" + to_line(run.score) + "\n";
}

}  // namespace

CaseRun run_case(std::uint64_t seed, const CaseOrder& order, const CaseRunOptions& options) {
  CaseRun run;
  run.hidden = make_case(seed, order);
  write_case(options.folder, run.hidden);
  try {
    Diagnostics diagnostics;
    const auto experiment = discrepancy::read_experiment(run.hidden.folder, diagnostics);
    if (!experiment) throw InvalidFile(diagnostics);
    discrepancy::DiagnosisOptions how;
    how.threads = options.threads;
    how.stop = options.stop;
    const Diagnosis diagnosis = discrepancy::diagnose(*experiment, how);
    run.verdict = diagnosis.verdict;
    run.score = score(run.hidden, run.verdict, true_error(run.hidden, diagnosis));
    run.score.lead = lead_of(run.hidden, diagnosis);
    score_force(run.hidden, diagnosis.force, run.score);
    run.score.alarm = diagnosis.before.statistic - diagnosis.before.level;
    run.notes = notes_of(run, diagnosis);
  } catch (const std::exception& error) {
    run.score = failed_score(run.hidden, error.what());
    run.notes = truth_text(run.hidden) + "\n" + error.what() + "\n";
  }
  return run;
}

}  // namespace pedicel::hidden
