#include "pedicel/discrepancy/scene_procedure/scene_diagnosis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "pedicel/discrepancy/scene_fit/scene_noise.h"
#include "pedicel/discrepancy/scene_procedure/robot_alone.h"
#include "pedicel/discrepancy/scene_procedure/scene_symptoms.h"
#include "pedicel/discrepancy/scene_procedure/scene_verdict.h"

namespace pedicel::discrepancy {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int polishing = 3;  // iterations with the finer mesh

bool healthy(const std::vector<SceneReadings>& readings) {
  return std::ranges::all_of(readings, [](const SceneReadings& one) { return one.healthy; });
}

class Procedure {
 public:
  Procedure(const SceneExperiment& experiment, const SceneDiagnosisOptions& options)
      : experiment_(experiment),
        options_(options),
        data_(experiment),
        fine_(experiment, options.numerics, options.threads, options.stop) {}

  SceneDiagnosis run() {
    tell("simulating the scene as the files say", 0.0);
    out_.nominal = predictions_of(fine_, {});
    if (!healthy(out_.nominal)) return failed();
    widen_noise(fine_, data_, {});
    split_scene_trials(experiment_, misfits(), out_.fit_trials, out_.check_trials);
    search();
    polish();
    finish();
    return std::move(out_);
  }

 private:
  SceneDiagnosis failed() {
    out_.verdict.outcome = stopped() ? Outcome::unknown : Outcome::numerical;
    out_.verdict.partial = stopped();
    out_.verdict.remainder = "the scene as its files say cannot be simulated to its end";
    set_cost();
    return std::move(out_);
  }

  std::vector<double> misfits() const {
    std::vector<double> all;
    for (std::size_t t = 0; t < out_.nominal.size(); ++t) {
      SceneDataSet::Sum sum;
      for (const auto& one : data_.sums(static_cast<int>(t), out_.nominal[t])) sum += one;
      all.push_back(SceneDataSet::beyond_noise(sum));
    }
    return all;
  }

  // With a coarser mesh and step, whose own error counts as noise.
  void search() {
    SceneNumerics coarse = options_.search;
    coarse.distance = std::max(coarse.distance, options_.numerics.distance);
    coarse.dt = std::max(coarse.dt, options_.numerics.dt);
    SceneSimulator simulator(experiment_, coarse, options_.threads, options_.stop);
    SceneDataSet data(experiment_);
    widen_noise(simulator, data, {}, out_.nominal);
    SceneEvaluator evaluator(simulator, data);
    SceneSearchOptions how;
    how.trials = out_.fit_trials;
    how.check = out_.check_trials;
    how.threads = options_.threads;
    how.stop = [this] { return stopped() || late(); };
    how.progress = [this](const std::string& what, double share) {
      tell(what, 0.05 + 0.75 * share);
    };
    out_.findings = search_scene(evaluator, how);
    more_ += simulator.simulations();
  }

  // The model that is told, and its rivals, with the finer mesh.
  void polish() {
    SceneFindings& found = out_.findings;
    SceneEvaluator evaluator(fine_, data_);
    const auto refit = [&](SceneFitResult& fit) {
      if (stopped() || late()) return;
      SceneFitOptions how;
      how.trials = out_.fit_trials;
      how.iterations = polishing;
      fit = fit_scene(evaluator, fit.model, how);
    };
    tell("refitting with a finer mesh", 0.85);
    const bool keep_baseline = !found.clean.empty();
    if (found.explained()) {
      // Where the noise of predictions is, depends on the model.
      widen_noise(fine_, data_, {found.candidates.front().fit.model.effects});
      refit(found.candidates.front().fit);
    } else if (!keep_baseline) {
      refit(found.baseline);
    }
    out_.model = found.model().model.effects;
    out_.extended = predictions_of(fine_, {out_.model});
    out_.refitted =
        found.explained() ? predictions_of(fine_, {found.baseline.model.effects}) : out_.extended;
  }

  void finish() {
    tell("writing down what was found", 0.97);
    conclude_scene(fine_, data_, out_);
    out_.verdict.symptoms = scene_symptoms(experiment_, data_, out_.refitted);
    for (SymptomNumber& one : robot_alone(fine_, out_.model, data_.deviation(SceneChannel::force),
                                          data_.deviation(SceneChannel::moment)))
      out_.verdict.symptoms.push_back(std::move(one));
    out_.verdict.partial = out_.findings.partial;
    out_.text = findings_text(out_.findings, experiment_);
    set_cost();
  }

  void set_cost() {
    out_.verdict.simulations = fine_.simulations() + more_;
    out_.verdict.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  bool stopped() const { return options_.stop && *options_.stop; }
  bool late() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count() > options_.time_limit;
  }
  void tell(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  const SceneExperiment& experiment_;
  const SceneDiagnosisOptions& options_;
  Clock::time_point begin_ = Clock::now();
  SceneDataSet data_;
  SceneSimulator fine_;
  long more_ = 0;  // simulations beside
  SceneDiagnosis out_;
};

}  // namespace

void split_scene_trials(const SceneExperiment& experiment, const std::vector<double>& misfit,
                        std::vector<int>& fit, std::vector<int>& check) {
  bool stated = false;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const Trial::Use use = experiment.trials[t].use;
    stated = stated || use != Trial::Use::unset;
    (use == Trial::Use::check ? check : fit).push_back(static_cast<int>(t));
  }
  if (stated || fit.size() < 3) return;
  std::vector<int> order = fit;
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](int t) { return misfit[static_cast<std::size_t>(t)]; });
  check = {order[1]};
  std::erase(fit, order[1]);
}

SceneDiagnosis diagnose_scene(const SceneExperiment& experiment,
                              const SceneDiagnosisOptions& options) {
  return Procedure(experiment, options).run();
}

}  // namespace pedicel::discrepancy
