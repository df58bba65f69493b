#include "plugins/discrepancy/scene_next/scene_next.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/scene/smooth_readings.h"
#include "plugins/discrepancy/scene_fit/scene_noise.h"
#include "plugins/discrepancy/scene_next/motion_designs.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_models = 3;
constexpr std::size_t refitted_motions = 3;
constexpr double always = std::numeric_limits<double>::infinity();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double square(double x) {
  return x * x;
}

/// A model as it would act in another trial: what happened in one trial alone stays out.
SceneVariant variant_of(const Hypothesis& model) {
  SceneVariant variant{model.effects};
  std::erase_if(variant.effects,
                [](const plant::Effect& effect) { return effect.words.contains("trial"); });
  return variant;
}

/// call(samples, matrix of each prediction, name and unit of a column, kind of a column), in the
/// order of SceneDataSet::residual().
template <class Call>
void each_table(const Experiment& experiment, Trial& trial,
                std::span<const SceneReadings> predictions, const Call& call) {
  const auto all = [&](const auto& take) {
    std::vector<const Eigen::MatrixXd*> values;
    for (const SceneReadings& one : predictions) values.push_back(&take(one));
    return values;
  };
  struct Said {
    std::string name, unit;
    SceneChannel kind;
  };
  const auto marker = [&](long c, long each) {
    return experiment.markers[static_cast<std::size_t>(c / each)].name;
  };
  call(trial.markers, all([](const SceneReadings& r) -> auto& { return r.markers; }), [&](long c) {
    return Said{marker(c, 3) + "." + "xyz"[c % 3], "m", SceneChannel::position};
  });
  for (std::size_t i = 0; i < trial.pixels.size(); ++i)
    call(trial.pixels[i], all([i](const SceneReadings& r) -> auto& { return r.pixels[i]; }),
         [&](long c) {
           return Said{
               marker(c, 2) + "." + "uv"[c % 2] + " of camera " + experiment.cameras[i].name, "px",
               SceneChannel::pixel};
         });
  for (std::size_t i = 0; i < trial.wrenches.size(); ++i)
    call(trial.wrenches[i], all([i](const SceneReadings& r) -> auto& { return r.wrenches[i]; }),
         [&](long c) {
           return Said{(c < 3 ? "force " : "moment ") + std::string(1, "xyz"[c % 3]) + " at " +
                           experiment.wrenches[i].name,
                       c < 3 ? "N" : "N m", c < 3 ? SceneChannel::force : SceneChannel::moment};
         });
  const std::vector<std::string> joints = joint_names(experiment.robot);
  const auto joint = [&](const std::vector<int>& columns, long c) {
    return joints[static_cast<std::size_t>(columns[static_cast<std::size_t>(c)])];
  };
  call(trial.torques, all([](const SceneReadings& r) -> auto& { return r.torques; }), [&](long c) {
    return Said{"torque of " + joint(trial.torque_columns, c), "N m", SceneChannel::torque};
  });
  if (trial.follows_commands)
    call(trial.joints, all([](const SceneReadings& r) -> auto& { return r.joints; }), [&](long c) {
      return Said{joint(trial.joint_columns, c), "rad", SceneChannel::joint};
    });
}

/// Lays the first prediction into the trial's tables as if it had been measured, so that its
/// residual is zero; what one of the models does not see has no difference, and stays open.
void measure_first(const Experiment& experiment, Trial& trial,
                   std::span<const SceneReadings> predictions) {
  each_table(experiment, trial, predictions,
             [](Samples& samples, const std::vector<const Eigen::MatrixXd*>& all, const auto&) {
               if (samples.size() == 0) return;
               samples.value = *all.front();
               for (const Eigen::MatrixXd* other : all)
                 samples.value = other->array().isNaN().select(nothing, samples.value);
             });
}

// The deviations of all that was measured, stated or seen.
StatedNoise seen_noise(const Experiment& experiment, const SceneDataSet& data, int base) {
  StatedNoise noise;
  noise.position_std = data.deviation(SceneChannel::position);
  noise.pixel_std = data.deviation(SceneChannel::pixel);
  noise.force_std = data.deviation(SceneChannel::force);
  noise.moment_std = data.deviation(SceneChannel::moment);
  noise.torque_std = data.deviation(SceneChannel::torque);
  noise.joint_std = experiment.noise.joint_std;
  const Trial& trial = experiment.trials[static_cast<std::size_t>(base)];
  if (noise.joint_std) return noise;
  if (trial.follows_commands) {
    noise.joint_std = data.deviation(SceneChannel::joint);
    return noise;
  }
  // What the smoothed log leaves of the readings, of the noisiest joint.
  const double scatter = smooth_readings(trial.joints, 0.0).scatter().maxCoeff();
  if (scatter > 0.0) noise.joint_std = scatter;
  return noise;
}

class Choice {
 public:
  Choice(const Experiment& experiment, const SceneDataSet& data,
         const std::vector<OpenModel>& models, const SceneNextOptions& options)
      : experiment_(experiment), models_(models), options_(options), plan_(experiment) {
    plan_.trials.clear();
    // They name trials that are not in it.
    std::erase_if(plan_.effects,
                  [](const plant::Effect& effect) { return effect.words.contains("trial"); });
    next_.noise = seen_noise(experiment, data, options.base);
    plan_.noise = next_.noise;
    for (const OpenModel& one : models_) {
      next_.names.push_back(one.name);
      variants_.push_back(variant_of(one.fit->hypothesis));
    }
    for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t)
      old_samples_ += data.samples(t, always);
  }

  SceneNext run(long& simulations) {
    const std::vector<MotionDesign> designs = motion_designs(experiment_, options_.base);
    std::vector<Motion> motions = compare(designs);
    if (!motions.empty() && !stopped()) {
      refit(designs, motions);
      choose(designs, motions);
    }
    simulations += simulations_;
    return std::move(next_);
  }

 private:
  struct Motion {
    std::size_t design = 0;
    int samples = 0;
    double apart = 0.0;  // noise units in all, of the first model from the one nearest to it
    std::size_t other = 1;
    std::optional<double> refitted;
    std::vector<double> left;  // by model, what a refit leaves of its distance from the first
    std::vector<SceneReadings> predictions;
    double value() const { return refitted.value_or(apart); }
  };

  bool stopped() const { return options_.stop && *options_.stop; }

  // What the models are apart as they are fitted, for all motions; the best first.
  std::vector<Motion> compare(const std::vector<MotionDesign>& designs) {
    for (const MotionDesign& design : designs) plan_.trials.push_back(design.trial);
    std::vector<Motion> motions;
    if (designs.empty()) return motions;
    SceneSimulator simulator(plan_, options_.numerics, options_.threads, options_.stop);
    std::vector<SceneSimulator::Request> requests;
    for (std::size_t d = 0; d < designs.size(); ++d)
      for (const SceneVariant& variant : variants_)
        requests.push_back({&variant, static_cast<int>(d)});
    const std::vector<SceneReadings> all = simulator.run(requests);
    simulations_ += simulator.simulations();
    for (std::size_t d = 0; d < designs.size(); ++d) {
      Motion one;
      one.design = d;
      const auto first = all.begin() + static_cast<long>(d * variants_.size());
      one.predictions.assign(first, first + static_cast<long>(variants_.size()));
      // A motion in which one of the models breaks down cannot be promised to people.
      if (std::ranges::all_of(one.predictions, &SceneReadings::healthy))
        motions.push_back(std::move(one));
    }
    for (Motion& one : motions) measure_first(plan_, plan_.trials[one.design], one.predictions);
    const SceneDataSet data(plan_);
    for (Motion& one : motions) {
      const int t = static_cast<int>(one.design);
      one.samples = data.samples(t, always);
      one.apart = always;
      for (std::size_t v = 1; v < variants_.size(); ++v) {
        const double distance = residual(data, t, one.predictions[v]).norm();
        // Worth what it does against the hardest of the others.
        if (distance >= one.apart) continue;
        one.apart = distance;
        one.other = v;
      }
    }
    sort(motions);
    return motions;
  }

  static Eigen::VectorXd residual(const SceneDataSet& data, int trial,
                                  const SceneReadings& readings) {
    Eigen::VectorXd out(data.size(trial));
    data.residual(trial, readings, always, out);
    return out;
  }

  // By what a model that is wrong would leave of all samples, old and new, as the search weighs it.
  double worth(const Motion& one) const {
    return square(one.value()) / (old_samples_ + one.samples);
  }
  void sort(std::vector<Motion>& motions) const {
    // Stable: among equals the plainer one stands first.
    std::ranges::stable_sort(motions, std::ranges::greater{},
                             [this](const Motion& one) { return worth(one); });
  }

  // The best few again, less what a refit of both models would take away of the difference.
  void refit(const std::vector<MotionDesign>& designs, std::vector<Motion>& motions) {
    if (motions.size() > refitted_motions) {
      for (std::size_t i = refitted_motions; i < motions.size(); ++i) tell(designs, motions[i]);
      motions.resize(refitted_motions);
    }
    Experiment few = plan_;
    few.trials.clear();
    for (const Motion& one : motions) few.trials.push_back(plan_.trials[one.design]);
    SceneSimulator simulator(few, options_.numerics, options_.threads, options_.stop);
    SceneDataSet data(few);
    // A touch comes sooner or later with other noise of the encoders: there less can be promised.
    widen_noise(simulator, data, variants_.front());
    std::vector<Spread> spreads;
    for (const OpenModel& one : models_) spreads.push_back(spread_of(*one.fit));
    std::vector<SceneSimulator::Request> requests;
    for (int t = 0; t < static_cast<int>(motions.size()); ++t)
      for (const Spread& spread : spreads)
        for (const SceneVariant& variant : spread.moved) requests.push_back({&variant, t});
    const std::vector<SceneReadings> all = simulator.run(requests);
    simulations_ += simulator.simulations();
    std::size_t next = 0;
    for (std::size_t t = 0; t < motions.size(); ++t) {
      Motion& one = motions[t];
      const int trial = static_cast<int>(t);
      std::vector<Eigen::VectorXd> at;
      std::vector<Eigen::MatrixXd> ways;  // by model: what its numbers, as far as open, change
      for (std::size_t v = 0; v < models_.size(); ++v) {
        at.push_back(residual(data, trial, one.predictions[v]));
        Eigen::MatrixXd change(at.back().size(), static_cast<long>(spreads[v].moved.size()));
        for (long p = 0; p < change.cols(); ++p) {
          const SceneReadings& moved = all[next++];
          change.col(p).setZero();
          if (moved.healthy)
            change.col(p) = (residual(data, trial, moved) - at.back()) / spreads[v].step[p];
        }
        ways.push_back(change * spreads[v].root);
      }
      one.left.assign(models_.size(), 0.0);
      for (std::size_t v = 1; v < models_.size(); ++v)
        one.left[v] = left_of(at[v] - at[0], ways[0], ways[v]);
      const auto nearest = std::min_element(one.left.begin() + 1, one.left.end());
      one.refitted = *nearest;
      one.other = static_cast<std::size_t>(nearest - one.left.begin());
    }
    sort(motions);
  }

  /// What is open of a model's numbers: its covariance as a root, and the model with each moved.
  struct Spread {
    Eigen::MatrixXd root;
    Eigen::VectorXd step;  // of the unknowns
    std::vector<SceneVariant> moved;
  };
  Spread spread_of(const FitSummary& fit) const {
    Spread out;
    const int n = fit.hypothesis.size();
    if (fit.jacobian.cols() != n || n == 0) {
      out.root.resize(0, 0);
      return out;
    }
    // What a model leaves counts as noise of its numbers.
    Eigen::MatrixXd normal =
        fit.jacobian.transpose() * fit.jacobian / square(std::max(1.0, fit.misfit().rms()));
    for (int p = 0; p < n; ++p)
      normal(p, p) += 1.0 / square(fit.hypothesis.free[static_cast<std::size_t>(p)].width());
    const Eigen::MatrixXd covariance = normal.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    out.root = covariance.llt().matrixL();
    out.step.resize(n);
    const Eigen::VectorXd u = fit.hypothesis.unknowns(), high = fit.hypothesis.high();
    const SceneFitSettings& how = options_.settings.fit;
    for (int p = 0; p < n; ++p) {
      // As far as it may be off, where derivatives of a touch mean anything.
      const double step = std::clamp(std::sqrt(covariance(p, p)), how.least_step, how.most_step);
      out.step[p] = u[p] + step <= high[p] ? step : -step;
      Eigen::VectorXd moved = u;
      moved[p] += out.step[p];
      Hypothesis model = fit.hypothesis;
      model.set_unknowns(moved);
      out.moved.push_back(variant_of(model));
    }
    return out;
  }

  // The distance, as unlikely as it is where both models' numbers may move as far as they are open.
  static double left_of(const Eigen::VectorXd& difference, const Eigen::MatrixXd& one,
                        const Eigen::MatrixXd& other) {
    Eigen::MatrixXd both(difference.size(), one.cols() + other.cols());
    both << one, other;
    const Eigen::VectorXd onto = both.transpose() * difference;
    const Eigen::MatrixXd inner =
        Eigen::MatrixXd::Identity(both.cols(), both.cols()) + both.transpose() * both;
    return std::sqrt(std::max(0.0, difference.squaredNorm() - onto.dot(inner.ldlt().solve(onto))));
  }

  // Noise units in all from which on the search no longer calls the two a tie.
  double enough(const Motion& one) const {
    const SceneSearchSettings& how = options_.settings.search;
    const FitSummary &a = *models_.front().fit, &b = *models_[one.other].fit;
    const double left = SceneDataSet::beyond_noise(a.misfit());
    const double numbers = std::abs(a.hypothesis.size() - b.hypothesis.size());
    return std::sqrt((how.least_tie + how.tie_share * square(left) + how.number_price * numbers) *
                     (old_samples_ + one.samples));
  }

  void tell(const std::vector<MotionDesign>& designs, const Motion& one) {
    next_.tried.push_back({designs[one.design].action, one.apart, one.refitted});
  }

  void choose(const std::vector<MotionDesign>& designs, std::vector<Motion>& motions) {
    std::vector<SceneNext::Tried> others = std::move(next_.tried);
    next_.tried.clear();
    for (const Motion& one : motions) tell(designs, one);
    next_.tried.insert(next_.tried.end(), others.begin(), others.end());
    // Where one model stays too near, a motion that parts another one is a step all the same.
    if (motions.front().value() < enough(motions.front())) look_at_farther(motions);
    Motion& best = motions.front();
    const std::string pair = next_.names[0] + " from " + next_.names[best.other];
    const std::string units = std::to_string(std::lround(best.value())) + " noise units in all";
    if (best.value() < enough(best)) {
      next_.sentence = "No motion that was tried out parts " + pair + " (the best one by " + units +
                       ", and " + std::to_string(std::lround(enough(best))) + " are needed)";
      return;
    }
    set_channel(best);
    next_.sentence = "To tell " + pair + ": " + designs[best.design].action +
                     "; they then differ by " + units + ", most at " + next_.channel.name;
    plan(designs[best.design]);
    next_.predictions = std::move(best.predictions);
  }

  void look_at_farther(std::vector<Motion>& motions) const {
    std::optional<Motion> found;
    for (const Motion& one : motions)
      for (std::size_t v = 1; v < one.left.size(); ++v) {
        Motion farther = one;
        farther.refitted = one.left[v];
        farther.other = v;
        if (farther.value() >= enough(farther) && (!found || worth(farther) > worth(*found)))
          found = std::move(farther);
      }
    if (found) motions.insert(motions.begin(), std::move(*found));
  }

  // The channel with the largest difference of the two in one sample: people look at one curve.
  void set_channel(const Motion& best) {
    Trial trial = plan_.trials[best.design];
    const SceneDataSet data(plan_);
    double most = -1.0;
    each_table(plan_, trial, best.predictions,
               [&](const Samples& samples, const std::vector<const Eigen::MatrixXd*>& all,
                   const auto& said) {
                 for (long c = 0; c < samples.value.cols() && samples.size() > 0; ++c) {
                   const auto what = said(c);
                   const double noise = data.deviation(what.kind);
                   double largest = 0.0;
                   for (long r = 0; r < samples.size(); ++r) {
                     const double d = std::abs((*all[0])(r, c) - (*all[best.other])(r, c)) / noise;
                     if (d > largest) largest = d;
                   }
                   if (largest <= most) continue;
                   most = largest;
                   next_.channel = {what.name, what.unit, samples.time, {}, noise};
                   for (const Eigen::MatrixXd* one : all) {
                     const Eigen::VectorXd column = one->col(c);
                     next_.channel.series.emplace_back(column.begin(), column.end());
                   }
                 }
               });
  }

  // The motion as a plan: on the scene as it stands, with nothing measured.
  void plan(const MotionDesign& design) {
    Experiment planned = plan_;
    planned.title = "next: " + design.action;
    planned.noise = experiment_.noise;
    planned.trials = {design.trial};
    Trial& trial = planned.trials.front();
    // A name that no trial has yet, so that its folder can lie beside theirs.
    for (int i = 1;; ++i) {
      trial.name = "next_" + std::to_string(i);
      if (std::ranges::find(experiment_.trials, trial.name, &Trial::name) ==
          experiment_.trials.end())
        break;
    }
    trial.folder = trial.name;
    next_.experiment = std::move(planned);
  }

  const Experiment& experiment_;
  const std::vector<OpenModel>& models_;
  const SceneNextOptions& options_;
  Experiment plan_;  // all motions
  std::vector<SceneVariant> variants_;
  double old_samples_ = 0.0;
  long simulations_ = 0;
  SceneNext next_;
};

}  // namespace

std::vector<OpenModel> open_models(const SceneFindings& found) {
  std::vector<OpenModel> models;
  const auto add = [&](const SceneCandidate& one) {
    const std::string name = joined_names(one.names);
    if (models.size() < most_models &&
        std::ranges::find(models, name, &OpenModel::name) == models.end())
      models.push_back({name, &one.fit});
  };
  if (found.outcome == SceneFindings::Outcome::adequate || found.candidates.empty()) return {};
  add(found.candidates.front());
  for (const std::size_t r : found.competing) add(found.candidates[r]);
  for (const SceneCandidate& one : found.candidates)
    // Two causes always explain what one does.
    if (!found.explained() || (one.excess <= found.seen_units &&
                               one.names.size() <= found.candidates.front().names.size()))
      add(one);
  if (models.size() < 2 && !found.explained())
    models.push_back({"the refitted model", &found.baseline});
  return models;
}

SceneNext next_scene_experiment(const Experiment& experiment, const SceneDataSet& data,
                                const std::vector<OpenModel>& models,
                                const SceneNextOptions& options, long& simulations) {
  // Nothing to tell apart.
  if (models.size() < 2) return {};
  return Choice(experiment, data, models, options).run(simulations);
}

}  // namespace pedicel::discrepancy
