#include "plugins/discrepancy/procedure/next_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/fit/causes.h"
#include "plugins/discrepancy/procedure/trial_designs.h"
#include "plugins/discrepancy/simulate/channel.h"
#include "plugins/discrepancy/simulate/variant_plant.h"
#include "plugins/discrepancy/test/symptom_parts.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

/// The competing models as they would act in another trial: what happened in one trial alone stays
/// out.
/// A grip that slipped once does not slip again because it is asked for.
std::vector<Variant> variants_of(const std::vector<Hypothesis>& models) {
  std::vector<Variant> variants;
  for (const Hypothesis& model : models) {
    variants.push_back(model.variant());
    std::erase_if(variants.back().effects,
                  [](const plant::Effect& effect) { return effect.words.contains("trial"); });
  }
  return variants;
}

/// The same plant and markers without trials.
Experiment empty_copy(const Experiment& experiment) {
  // Not its trials, nor what went wrong in them.
  Experiment copy;
  copy.plant() = experiment.plant();
  copy.markers = experiment.markers;
  copy.noise = experiment.noise;
  copy.effects = experiment.effects;
  return copy;
}

// Where the grip rests, by the likeliest model of the plant itself.
// A design says how far to pull from where the point is. By the plant file's shape a plant that
// sags would already be pulled.
bool find_rest(Experiment probe, Variant variant, const DesignScales& scales,
               const Numerics& numerics, const Vec3& gravity, long& simulations, Vec3& rest) {
  // Where the grip is, not where a faulty sensor sees it.
  // People see where the grip is, and the wrong sensor would send the hand to another place.
  std::erase_if(variant.effects, is_of_sensor);
  std::erase_if(probe.effects, is_of_sensor);
  probe.markers = {{"grip", scales.grip}};
  Trial trial;
  trial.name = "rest";
  trial.gravity = gravity;
  // Two samples are the fewest that make a trial.
  // Trials begin settled, so the first sample is the rest, and nothing needs to be run to it.
  trial.markers.time = {0.0, numerics.dt};
  trial.markers.value = Eigen::MatrixXd::Zero(2, 3);
  probe.trials = {trial};
  Simulator simulator(probe, numerics, 1);
  const Simulator::Request request{&variant, 0};
  const Prediction prediction = simulator.run(std::span(&request, 1)).front();
  simulations += simulator.simulations();
  rest = prediction.markers.row(0).transpose();
  // A model that finds no rest may still be right, but no trial can be planned with it.
  return prediction.healthy && rest.allFinite();
}

/// What separates two predictions of a trial.
struct Separation {
  double total = 0.0;    // noise units, whitened
  double largest = 0.0;  // noise units, of one sample
  int column = 0;        // markers' columns, then the force's
  int sample = 0;
};

Separation separation_of(const DataSet& data, int trial, const Prediction& a, const Prediction& b) {
  Separation result;
  const int size = data.size(std::span(&trial, 1));
  Eigen::VectorXd ra(size), rb(size);
  // Both against the same design, whose samples are zeros. They cancel in the difference, and what
  // is left is the distance of the two models in noise units.
  data.residual(trial, a, 1.0, ra);
  data.residual(trial, b, 1.0, rb);
  // Whitened: noise that lasts over many samples counts as one.
  result.total = (ra - rb).norm();
  // Unwhitened for the sentence: people look at one channel at one time, and not at a filter's
  // output.
  const Eigen::MatrixXd difference =
      data.scaled_residual(trial, a) - data.scaled_residual(trial, b);
  for (Eigen::Index c = 0; c < difference.cols(); ++c)
    for (Eigen::Index i = 0; i < difference.rows(); ++i) {
      const double size_here = std::abs(difference(i, c));
      // Turned round, so that a NaN is never the largest.
      if (!(size_here > result.largest)) continue;
      result.largest = size_here;
      result.column = static_cast<int>(c);
      result.sample = static_cast<int>(i);
    }
  return result;
}

/// A design that was simulated for every competing model.
struct Tried {
  const TrialDesign* design = nullptr;
  std::vector<Prediction> predictions;
  Separation nearest;  // of the first competing model from the one least far from it
  int other = 1;
  // Noise units a minute: a long experiment parts most things, and would always win.
  double worth() const { return nearest.total / design->minutes; }
};

std::vector<Tried> try_designs(Experiment designs, const DataSet& data,
                               const std::vector<const TrialDesign*>& list,
                               const std::vector<Variant>& variants,
                               const NextExperimentOptions& options, long& simulations) {
  for (const TrialDesign* design : list) designs.trials.push_back(design->trial);
  // All designs and models at once, side by side on all threads.
  Simulator simulator(designs, options.numerics, options.threads, options.stop);
  std::vector<Simulator::Request> requests;
  // By design, then by model: the answers come in this order.
  for (std::size_t t = 0; t < list.size(); ++t)
    for (const Variant& variant : variants) requests.push_back({&variant, static_cast<int>(t)});
  std::vector<Prediction> all = simulator.run(requests);
  simulations += simulator.simulations();
  DataSet measured(designs);
  // As these people measure, not as the design would like.
  // A design has no samples from which noise could be read.
  measured.set_noise(data.position_noise(), data.force_noise());
  std::vector<Tried> tried;
  for (std::size_t t = 0; t < list.size(); ++t) {
    Tried one{list[t], {}, {}, 1};
    bool healthy = true;
    for (std::size_t v = 0; v < variants.size(); ++v) {
      one.predictions.push_back(std::move(all[t * variants.size() + v]));
      healthy = healthy && one.predictions.back().healthy;
    }
    // A trial in which one of the models breaks down cannot be promised to people.
    if (!healthy) continue;
    one.nearest.total = std::numeric_limits<double>::infinity();
    // From the first, which is the likeliest. Pairs of the others would be a question that nobody
    // has asked.
    for (std::size_t v = 1; v < variants.size(); ++v) {
      const Separation s =
          separation_of(measured, static_cast<int>(t), one.predictions[0], one.predictions[v]);
      // A design is worth what it does against the hardest of the others.
      if (s.total >= one.nearest.total) continue;
      one.nearest = s;
      one.other = static_cast<int>(v);
    }
    tried.push_back(std::move(one));
  }
  return tried;
}

// What tells a cause from its look-alikes where no trial that can be simulated does.
// A plumb line, a ruler or a known mass: instruments are not told apart by plants.
std::string tie_breaker(const std::vector<Hypothesis>& models) {
  for (const Hypothesis& model : models)
    if (const effects::EffectDefinition* known = effects::find_effect(model.name))
      if (!known->tells_apart.empty()) return known->tells_apart;
  return "repeat the trials at twice the amplitude with one more marker";
}

std::string name_of(const Hypothesis& model) {
  return model.name.empty() ? "the refitted model" : model.name;
}

// Where no design could be simulated.
// A sentence is better than nothing: the verdict is ambiguous, and the reader waits for a way out.
NextExperiment by_hand(const std::vector<Hypothesis>& models) {
  NextExperiment next;
  next.sentence = "To tell " + name_of(models[0]) + " from " + name_of(models[1]) + ": " +
                  tie_breaker(models) + ".";
  return next;
}

std::string channel_of(const Experiment& experiment, int column) {
  const auto markers = static_cast<int>(3 * experiment.markers.size());
  const std::string axis = std::string(".") + "xyz"[column % 3];
  return (column < markers ? experiment.markers[column / 3].name : "force") + axis;
}

// A name that no trial has yet.
std::string free_name(const Experiment& experiment) {
  for (int i = 1;; ++i) {
    const std::string name = "next_" + std::to_string(i);
    if (std::ranges::find(experiment.trials, name, &Trial::name) == experiment.trials.end())
      return name;
  }
}

// The trial as a plan: on the plant as it stands, with nothing measured.
Experiment planned(const Experiment& experiment, const TrialDesign& design) {
  Experiment plan = empty_copy(experiment);
  plan.title = "next: " + design.action;
  plan.plants.front().path = experiment.plants.front().path;
  plan.trials = {design.trial};
  Trial& trial = plan.trials.front();
  // So that the folder can be put beside the others as it is.
  trial.name = free_name(experiment);
  trial.folder = trial.name;
  // An empty table keeps its times. Zeros would be taken for measurements by whoever forgets to
  // fill it.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  trial.markers.value.setConstant(nothing);
  trial.force.value.setConstant(nothing);
  return plan;
}

NextExperiment described(const Experiment& experiment, const DataSet& data, const Tried& best,
                         const std::vector<Hypothesis>& models) {
  const auto markers = static_cast<int>(3 * experiment.markers.size());
  const Separation& s = best.nearest;
  const bool force = s.column >= markers;
  const Trial& trial = best.design->trial;
  NextExperiment next;
  next.channel = channel_of(experiment, s.column);
  next.unit = force ? "N" : "m";
  // For the plot: curves that lie within it cannot be told apart by eye.
  next.noise = (force ? data.force_noise() : data.position_noise()).std;
  next.time = force ? trial.force.time : trial.markers.time;
  next.separation = s.total;
  next.minutes = best.design->minutes;
  for (std::size_t v = 0; v < models.size(); ++v) {
    const Eigen::MatrixXd& value = force ? best.predictions[v].force : best.predictions[v].markers;
    const Eigen::VectorXd column = value.col(force ? s.column - markers : s.column);
    next.names.push_back(name_of(models[v]));
    next.series.emplace_back(column.begin(), column.end());
  }
  next.sentence = best.design->action + ": " + next.names[0] + " and " + next.names[best.other] +
                  " then differ by " + short_number(s.total) + " times the noise in all, most (" +
                  short_number(s.largest) + " times) at " + next.channel + " after " +
                  short_number(next.time[s.sample]) + " s. It takes about " +
                  short_number(next.minutes) + " minutes.";
  return next;
}

}  // namespace

NextExperiment next_experiment(const Experiment& experiment, const DataSet& data,
                               const std::vector<Hypothesis>& models,
                               const NextExperimentOptions& given, long& simulations) {
  // Nothing to tell apart.
  if (models.size() < 2) return {};
  // Six noise units in all are 18 nats, as much as a named cause is worth: less would leave the
  // next verdict as ambiguous as this one.
  const double enough = given.settings.levels.separating;
  NextExperimentOptions options = given;
  // The choice needs no more accuracy than the competing models' own; a coarse step makes it
  // cheap.
  options.numerics.dt = std::max(options.numerics.dt, options.settings.accuracy.design_dt);
  options.numerics.quiet = 1;  // nobody has seen yet when a design rests
  // As coarse as the plant file draws it. The fits may have had to be finer than that, for data
  // more precise than this choice.
  options.numerics.distance = std::max(options.numerics.distance, experiment.plant().distance);
  const std::vector<Variant> variants = variants_of(models);
  DesignScales scales = design_scales(experiment);
  // A plant that is turned is another experiment: gravity bends it along another side of itself. It
  // tells its own shape from what acts from outside.
  Experiment upright = empty_copy(experiment), turned = upright;
  turned.plant() = turned_plant(experiment.plant());
  const Vec3 gravity =
      experiment.trials.empty() ? Vec3(0, 0, -9.81) : experiment.trials.front().gravity;
  if (!find_rest(upright, variants[0], scales, options.numerics, gravity, simulations,
                 scales.rest) ||
      !find_rest(turned, variants[0], scales, options.numerics, gravity, simulations,
                 scales.turned_rest))
    // Both rests are needed before any design, as all designs are made at once.
    return by_hand(models);
  const std::vector<TrialDesign> designs = trial_designs(experiment, scales);
  // Two simulators, since a simulator has one plant.
  std::vector<const TrialDesign*> plain, around;
  for (const TrialDesign& design : designs) (design.turned ? around : plain).push_back(&design);
  std::vector<Tried> tried = try_designs(upright, data, plain, variants, options, simulations);
  for (Tried& one : try_designs(turned, data, around, variants, options, simulations))
    tried.push_back(std::move(one));
  if (tried.empty()) return by_hand(models);
  const auto better = [enough](const Tried& a, const Tried& b) {
    const bool ea = a.nearest.total >= enough, eb = b.nearest.total >= enough;
    // One that separates goes before all that do not; among those, time counts.
    // Else a quick trial that parts nothing would win by its minutes.
    if (ea != eb) return eb;
    return ea ? a.worth() < b.worth() : a.nearest.total < b.nearest.total;
  };
  // The first of equals, in the order of the designs: simple ones stand first.
  const Tried& best = *std::ranges::max_element(tried, better);
  NextExperiment next = described(experiment, data, best, models);
  // A plan on a turned plant would need another plant file, and the data of both could not be
  // fitted together.
  if (next.separation >= enough && !best.design->turned) {
    next.experiment = planned(experiment, *best.design);
    next.predictions = best.predictions;
  }
  // Said with its number, so that a reader sees how far from deciding it is.
  if (next.separation < enough)
    next.sentence = "No trial of those that were tried out separates " + next.names[0] + " from " +
                    next.names[best.other] + " (the best one by " + short_number(next.separation) +
                    " times the noise in all). What can: " + tie_breaker(models) + ".";
  return next;
}

// Without a known cause there are no models to part. What helps is to see how the residual grows
// with the amplitude: that is what tells kinds of force apart.
NextExperiment next_look(const Experiment& experiment, const DataSet& data,
                         const std::vector<Prediction>& predictions) {
  NextExperiment next;
  if (predictions.size() != experiment.trials.size()) return next;
  double most = 0.0;
  int trial = -1, column = 0;
  Eigen::Index sample = 0;
  for (int t = 0; t < static_cast<int>(predictions.size()); ++t) {
    const Eigen::MatrixXd r = data.scaled_residual(t, predictions[t]);
    for (int c = 0; c < r.cols(); ++c) {
      double sum = 0.0, count = 0.0, peak = 0.0;
      Eigen::Index at = 0;
      for (Eigen::Index i = 0; i < r.rows(); ++i) {
        // Gaps are no agreement.
        if (!std::isfinite(r(i, c))) continue;
        sum += r(i, c) * r(i, c), count += 1.0;
        if (std::abs(r(i, c)) > peak) peak = std::abs(r(i, c)), at = i;
      }
      // By the mean over a record: one outlier asks for no experiment.
      if (count == 0.0 || std::sqrt(sum / count) <= most) continue;
      // Over all trials and channels: one place to look at, since people repeat one trial.
      most = std::sqrt(sum / count);
      trial = t, column = c, sample = at;
    }
  }
  if (trial < 0) return next;
  const Trial& worst = experiment.trials[trial];
  const ChannelPlace at = channel_at(experiment, trial, column);
  next.channel = at.name;
  const double time = at.samples->time[sample];
  next.sentence =
      "Repeat " + worst.name + " at half and at twice its amplitude" +
      (at.kind == ChannelKind::position
           ? ", with one more marker beside " + experiment.markers[column / 3].name
           : std::string()) +
      ": there the residual is largest (" + short_number(most) + " times the noise at " +
      next.channel + ", most after " + short_number(time) +
      " s). Whether it grows in proportion, faster or not at all tells what kind of force is "
      "missing.";
  return next;
}

}  // namespace pedicel::discrepancy
