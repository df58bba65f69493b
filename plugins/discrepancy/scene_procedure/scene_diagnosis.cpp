#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "plugins/discrepancy/scene_fit/scene_noise.h"
#include "plugins/discrepancy/scene_procedure/robot_alone.h"
#include "plugins/discrepancy/scene_procedure/scene_symptoms.h"
#include "plugins/discrepancy/scene_procedure/scene_verdict.h"
#include "plugins/discrepancy/select/symptom_numbers.h"

namespace pedicel::discrepancy {

namespace {

using Clock = std::chrono::steady_clock;

bool healthy(const std::vector<SceneReadings>& readings) {
  return std::ranges::all_of(readings, [](const SceneReadings& one) { return one.healthy; });
}

class Procedure {
 public:
  Procedure(const Experiment& experiment, const SceneDiagnosisOptions& options)
      : experiment_(experiment),
        options_(options),
        data_(experiment),
        // The simulator that judges. The search has a coarser one of its own, so that no number of
        // a verdict comes from a coarse mesh.
        fine_(experiment, options.numerics, options.threads, options.stop) {}

  SceneDiagnosis run() {
    // First of all, as this shows whether the scene can be simulated to its end. Nothing else is
    // worth trying before that.
    tell("simulating the scene as the files say", 0.0);
    out_.nominal = predictions_of(fine_, {});
    if (!healthy(out_.nominal)) return failed();
    // Contacts begin a step earlier or later with other noise of the encoders. Without that
    // uncertainty a few samples about each touch would weigh more than all others.
    widen_noise(fine_, data_, {});
    // After the noise, because the split goes by the misfits.
    split_scene_trials(experiment_, misfits(), out_.fit_trials, out_.check_trials);
    search();
    if (stopped() && options_.cut_short) {
      options_.cut_short();
      cut_ = true;
    }
    polish();
    finish();
    return std::move(out_);
  }

 private:
  SceneDiagnosis failed() {
    // Stopped, nothing is known of the numbers.
    out_.verdict.outcome = stopped() ? Outcome::unknown : Outcome::numerical;
    out_.verdict.partial = stopped();
    out_.verdict.remainder = "the scene as its files say cannot be simulated to its end";
    set_cost();
    return std::move(out_);
  }

  std::vector<double> misfits() const {
    std::vector<double> all;
    for (std::size_t t = 0; t < out_.nominal.size(); ++t) {
      Misfit sum;
      for (const auto& one : data_.sums(static_cast<int>(t), out_.nominal[t])) sum += one;
      all.push_back(SceneDataSet::beyond_noise(sum));
    }
    return all;
  }

  SceneNumerics coarse() const {
    SceneNumerics how;
    // Never finer than what judges: an experiment may ask for less than the search's default.
    how.distance = std::max(options_.settings.search.mesh, options_.numerics.distance);
    how.dt = std::max(options_.settings.search.dt, options_.numerics.dt);
    how.run_steps =
        std::max(1.0, std::round(options_.settings.search.run_dt / experiment_.scene.dt));
    return how;
  }

  // With a coarser mesh and step, whose own error counts as noise.
  void search() {
    // A search that is cut short ends its simulations, as at the time limit: half of one says what
    // is not so.
    SceneSimulator simulator(experiment_, coarse(), options_.threads,
                             options_.cut_short ? nullptr : options_.stop);
    SceneDataSet data(experiment_);
    // The finer predictions are at hand: what the coarse ones are off by is known, sample by
    // sample, and counts as noise there.
    widen_noise(simulator, data, {}, out_.nominal);
    SceneEvaluator evaluator(simulator, data, options_.settings);
    SceneSearchOptions how;
    how.trials = out_.fit_trials;
    how.check = out_.check_trials;
    how.threads = options_.threads;
    how.parts = options_.parts;
    // Late is no error: what is known so far is concluded, and the verdict says `partial`.
    how.stop = [this] { return stopped() || late(); };
    how.progress = [this](const std::string& what, double share) {
      tell(what, 0.05 + 0.75 * share);
    };
    how.renew_noise = [&](const std::vector<plant::Effect>& effects) {
      widen_noise(simulator, data, {effects}, predictions_of(fine_, {effects}));
    };
    how.push_shift = [&](const std::vector<plant::Effect>& effects) {
      return push_shift(simulator, effects, data_.deviation(SceneChannel::force),
                        options_.settings.robot);
    };
    how.refit_finely = [this](const Hypothesis& model) { return refitted_finely(model); };
    out_.findings = search_scene(evaluator, how);
    // The simulator goes with this function, and its count with it.
    more_ += simulator.simulations();
  }

  FinerFit refitted_finely(const Hypothesis& model) {
    SceneEvaluator evaluator(fine_, data_, options_.settings);
    const FitOptions how = evaluator.options(out_.fit_trials, options_.settings.search.polishing);
    FinerFit fine{fit_scene(evaluator, model, how), 0.0, {}};
    fine.excess = SceneDataSet::beyond_noise(fine.fit.misfit());
    if (out_.check_trials.empty()) return fine;
    fine.check_excess =
        SceneDataSet::beyond_noise(evaluator.misfit(fine.fit.hypothesis, out_.check_trials));
    return fine;
  }

  // The model that is told, and those that compete with it, with the finer mesh.
  // Only few iterations, and from where the search ended: which cause it is has been decided.
  void polish() {
    SceneFindings& found = out_.findings;
    // The next motion is chosen with the search's mesh. Numbers of another one would make a
    // difference that no model makes.
    searched_ = found;
    SceneEvaluator evaluator(fine_, data_, options_.settings);
    const auto refit = [&](FitSummary& fit) {
      if (stopped() || late()) return;
      // The search has found the valley. A finer mesh only moves its bottom a little, and each
      // iteration takes a simulation for each number.
      fit = fit_scene(evaluator, fit.hypothesis,
                      evaluator.options(out_.fit_trials, options_.settings.search.polishing));
    };
    tell("refitting with a finer mesh", 0.85);
    // Where the baseline alone explains some trials, it was fitted to these. A refit to all would
    // spread what is wrong in the others over them.
    const bool keep_baseline = !found.clean.empty();
    if (found.explained()) {
      // Where the noise of predictions is, depends on the model.
      // Touches are elsewhere in time by now. Misfits of all models are then taken with this one's
      // noise, so that they can be compared.
      widen_noise(fine_, data_, {found.candidates.front().fit.hypothesis.effects});
      refit(found.candidates.front().fit);
      doubt(found.candidates.front().fit);
    } else if (!keep_baseline) {
      // An unseen plant's place moves touches as a cause does.
      if (found.baseline.hypothesis.size() > 3)
        widen_noise(fine_, data_, {found.baseline.hypothesis.effects});
      // Where the files are right the search's own mesh and step moved away from them.
      const Hypothesis models[] = {found.baseline.hypothesis,
                                   scene_baseline(experiment_, options_.settings)};
      const Eigen::MatrixXd left = evaluator.residuals(models, evaluator.options(out_.fit_trials));
      if (left.col(1).squaredNorm() < left.col(0).squaredNorm())
        found.baseline.hypothesis = models[1];
      refit(found.baseline);
      doubt(found.baseline);
    }
    out_.model = found.model().hypothesis.effects;
    out_.extended = predictions_of(fine_, {out_.model});
    // Without a cause there is one model, and it is simulated once.
    out_.refitted = found.explained() ? predictions_of(fine_, {found.baseline.hypothesis.effects})
                                      : out_.extended;
  }

  void doubt(FitSummary& fit) {
    if (stopped() || late()) return;
    std::vector<int> stretch;
    for (const int t : out_.fit_trials) {
      // Trials have none in common.
      const int next = stretch.empty() ? 0 : *std::ranges::max_element(stretch) + 1;
      for (const int one : data_.stretches(t, options_.settings.search.rest_stretch))
        stretch.push_back(next + one);
    }
    raise_errors(fit, stretch);
    widen_errors(fit, doubts(fit.hypothesis.effects));
    doubt_place(fit);
  }

  // Of a plant that nothing shows both the fit and the wrench say where along the tool it is
  // pushed. What they differ by, neither knows: the valley is rough, and its floor hardly falls.
  void doubt_place(FitSummary& fit) {
    std::optional<Vec3> shift;
    for (int p = 0; p < fit.hypothesis.size() && p < fit.standard_error.size(); ++p) {
      const effects::FreeParameter& free = fit.hypothesis.free[static_cast<std::size_t>(p)];
      if (!told_of_baseline(fit.hypothesis.effects[static_cast<std::size_t>(free.effect)], free))
        continue;
      if (!shift)
        shift = push_shift(fine_, fit.hypothesis.effects, data_.deviation(SceneChannel::force),
                           options_.settings.robot);
      fit.standard_error[p] =
          std::hypot(fit.standard_error[p], (*shift)[free.component] / free.scale);
    }
  }

  // What predictions of a model may be off by, over the fitted trials in units of the noise: what a
  // coarser mesh changes. Two honest solvers differ by as much, from the first sample of a touch to
  // its last, and so do numbers fitted with them. Standard errors of white noise would leave that
  // out.
  Eigen::MatrixXd doubts(const std::vector<plant::Effect>& effects) {
    const SceneVariant own{effects};
    SceneSimulator other(experiment_, coarse(), options_.threads, options_.stop);
    std::vector<SceneSimulator::Request> asked;
    for (const int t : out_.fit_trials) asked.push_back({&own, t});
    const std::vector<SceneReadings> here = fine_.run(asked), coarser = other.run(asked);
    more_ += other.simulations();
    long rows = 0, first = 0;
    for (const int t : out_.fit_trials) rows += data_.size(t);
    Eigen::MatrixXd off = Eigen::MatrixXd::Zero(rows, 1);
    for (std::size_t i = 0; i < out_.fit_trials.size(); ++i) {
      const int t = out_.fit_trials[i], size = data_.size(t);
      const auto residual = [&](const SceneReadings& readings) {
        Eigen::VectorXd r(size);
        data_.residual(t, readings, std::numeric_limits<double>::infinity(), r);
        return r;
      };
      if (coarser[i].healthy && here[i].healthy)
        off.col(0).segment(first, size) = residual(coarser[i]) - residual(here[i]);
      first += size;
    }
    return off;
  }

  // m, W, of the place of plants that nothing shows but what they do to the arm: the largest.
  Vec3 standing_error() const {
    const FitSummary& fit = out_.findings.model();
    Vec3 error = Vec3::Zero();
    for (int p = 0; p < fit.hypothesis.size() && p < fit.standard_error.size(); ++p) {
      const effects::FreeParameter& free = fit.hypothesis.free[static_cast<std::size_t>(p)];
      if (free.name != "offset" || free.prior == 0.0) continue;
      error[free.component] = std::max(error[free.component], fit.standard_error[p] * free.scale);
    }
    return error;
  }

  void finish() {
    tell("writing down what was found", 0.97);
    // With predictions of the fine simulator throughout, since these numbers are shown.
    conclude_scene(fine_, data_, options_.settings.search, out_);
    plan_next();
    // Of the refitted model and not of the extended one: a symptom is what the data show beside
    // what everybody would fit.
    const auto symptoms_of = [&](const std::vector<SceneReadings>& readings) {
      return scene_symptoms(experiment_, data_, readings, options_.settings.symptoms);
    };
    out_.verdict.symptoms = symptoms_of(out_.refitted);
    out_.verdict.left.symptoms = names_that_show(symptoms_of(out_.extended));
    for (SymptomNumber& one : robot_alone(fine_, out_.model, data_.deviation(SceneChannel::force),
                                          data_.deviation(SceneChannel::moment), standing_error(),
                                          options_.settings.robot))
      out_.verdict.symptoms.push_back(std::move(one));
    out_.verdict.partial = out_.findings.partial;
    out_.text = findings_text(out_.findings, experiment_);
    for (const std::string& sentence : changed_settings(options_.settings))
      out_.text += "  " + sentence + "\n";
    // Last, so that what the conclusion simulated counts, too.
    set_cost();
  }

  // The motion that parts the models which are left open.
  void plan_next() {
    const std::vector<OpenModel> models = open_models(searched_);
    // What was cut short has not looked at all models.
    if (stopped() || late() || searched_.partial || models.size() < 2) return;
    tell("looking for the motion that decides", 0.9);
    SceneNextOptions how;
    how.numerics = coarse();
    how.settings = options_.settings;
    how.threads = options_.threads;
    how.stop = options_.stop;
    // Where something is wrong most clearly, motions like it show it best.
    const std::vector<double> misfit = misfits();
    for (const int t : out_.fit_trials)
      if (misfit[static_cast<std::size_t>(t)] > misfit[static_cast<std::size_t>(how.base)] ||
          t == out_.fit_trials.front())
        how.base = t;
    out_.next = next_scene_experiment(experiment_, data_, models, how, more_);
    tell_next_motion(out_.next, out_.verdict);
  }

  void set_cost() {
    out_.verdict.simulations = fine_.simulations() + more_;
    out_.verdict.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
  }
  bool stopped() const { return options_.stop && *options_.stop; }
  bool late() const {
    // A steady clock, which nobody sets back.
    return cut_ ||
           std::chrono::duration<double>(Clock::now() - begin_).count() > options_.time_limit;
  }
  void tell(const std::string& what, double share) const {
    if (options_.progress) options_.progress(what, share);
  }

  const Experiment& experiment_;
  const SceneDiagnosisOptions& options_;
  Clock::time_point begin_ = Clock::now();
  SceneDataSet data_;
  SceneSimulator fine_;
  long more_ = 0;           // simulations beside
  bool cut_ = false;        // by a stop that was taken back
  SceneFindings searched_;  // as the search left them
  SceneDiagnosis out_;
};

}  // namespace

void split_scene_trials(const Experiment& experiment, const std::vector<double>& misfit,
                        std::vector<int>& fit, std::vector<int>& check) {
  bool stated = false;
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
    const Trial::Use use = experiment.trials[t].use;
    stated = stated || use != Trial::Use::unset;
    // Trials without a word are fitted, also where others have one.
    (use == Trial::Use::check ? check : fit).push_back(static_cast<int>(t));
  }
  // Of two trials one alone would be left to fit, and a cause that acts in the other would never be
  // seen.
  if (stated || fit.size() < 3) return;
  std::vector<int> order = fit;
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&](int t) { return misfit[static_cast<std::size_t>(t)]; });
  // The second largest: the largest is where a cause shows best, and is needed for the fit. One
  // with no misfit would test nothing.
  check = {order[1]};
  std::erase(fit, order[1]);
}

SceneDiagnosis diagnose_scene(const Experiment& experiment, const SceneDiagnosisOptions& options) {
  return Procedure(experiment, options).run();
}

}  // namespace pedicel::discrepancy
