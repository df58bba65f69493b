#include "plugins/discrepancy/fit/numerics.h"

#include <cmath>

#include "plugins/discrepancy/fit/shift_fit.h"

namespace pedicel::discrepancy {

namespace {

// An error c h^2 is a quarter with h/2. So what halving changes is 3/4 of the error, and the error
// 4/3 of that (Richardson).
constexpr double extrapolation = 4.0 / 3.0;

// RMS per sample of a whitened vector.
double rms(const Eigen::VectorXd& v, int samples) {
  // Over samples, not over entries: those after the horizon are zero, and would thin out the rest.
  return samples > 0 ? v.norm() / std::sqrt(static_cast<double>(samples)) : 0.0;
}

// What a shifted prediction still lacks.
Correction change(const Shift& shift, const Predictions& to, const Predictions& shifted) {
  Correction made{shift, {}};
  add_difference(made.rest, 1.0, to, shifted);
  return made;
}

void add(Correction& sum, double share, const Correction& more) {
  sum.shift.add(share, more.shift);
  const bool first = sum.rest.empty();
  if (first) sum.rest.resize(more.rest.size());
  for (std::size_t t = 0; t < more.rest.size(); ++t) {
    const Eigen::MatrixXd markers = share * more.rest[t].markers,
                          force = share * more.rest[t].force;
    sum.rest[t].markers = first ? markers : Eigen::MatrixXd(sum.rest[t].markers + markers);
    sum.rest[t].force = first ? force : Eigen::MatrixXd(sum.rest[t].force + force);
    const Eigen::MatrixXd wrench = share * more.rest[t].wrench;
    sum.rest[t].wrench = first ? wrench : Eigen::MatrixXd(sum.rest[t].wrench + wrench);
  }
}

/// Simulates the fitted model with several numerics and compares.
class Comparison {
 public:
  Comparison(const Experiment& experiment, const DataSet& data, const FitSummary& base,
             const Numerics& numerics, const FitOptions& options, int threads,
             const std::atomic<bool>* stop)
      : experiment_(experiment),
        data_(data),
        base_(base),
        options_(options),
        threads_(threads),
        stop_(stop),
        // Kept for the whole comparison, since most of what is simulated has the model's own mesh
        // and step.
        own_(experiment, numerics, threads, stop),
        shift_(own_, data, base.hypothesis, Shift{}, options) {
    Numerics half_step = numerics, file_mesh = numerics;
    // One at a time. With both halved at once the sum would come out as well, for more time, but
    // not which of the two to refine.
    half_step.dt *= 0.5;
    file_mesh.distance = experiment.plant().distance;
    // Near junctions a mesh coarser than the file's is not yet of second order: its difference from
    // the file's counts whole, and halving begins there.
    const bool coarse = numerics.distance > file_mesh.distance;
    const bool same = numerics.distance == file_mesh.distance;
    Numerics fine_mesh = coarse ? file_mesh : numerics, plain_mesh = file_mesh;
    fine_mesh.distance *= 0.5;
    // As a solver does that leads a branch straight into a whole segment of its stem. What that
    // changes is of first order in the spacing; fits may choose how much of it is in the data.
    plain_mesh.junction = 0.0;
    Simulator files(experiment, file_mesh, threads, stop);
    const Predictions& now = shift_.now();
    const Predictions step = run(half_step), fine = run(fine_mesh), plain = run(plain_mesh);
    // Of one simulator where both meshes are the same, so that nothing is simulated twice.
    const Predictions file = same ? now : run(files, {Shift{}}).front();
    // Each about the predictions that it is a difference from, so that the ways add up to one.
    const Shift by_step = shift_.stands_for(step, now), by_file = shift_.stands_for(file, now),
                by_fine = shift_.stands_for(fine, coarse ? file : now),
                by_junction = shift_.stands_for(plain, file);
    // Simulated again with the shift. A shift by its first order would leave in the rest what a
    // swing's phase does to the second.
    const auto at_own = run(own_, {by_step, by_file, by_fine});
    const auto at_file = run(same ? own_ : files, {by_junction, by_fine});
    const Correction to_file = change(by_file, file, at_own[1]),
                     to_fine = change(by_fine, fine, coarse ? at_file[1] : at_own[2]);
    add(step_, extrapolation, change(by_step, step, at_own[0]));
    // From a coarser mesh in two steps: to the file's as it is, and from there by Richardson's law.
    if (coarse) add(mesh_, 1.0, to_file);
    add(mesh_, extrapolation, to_fine);
    add(made_.own, 1.0, step_);
    add(made_.own, 1.0, mesh_);
    // What the file's own mesh has more than an exact prediction. From a finer mesh that is the way
    // to the file's less the way to the exact one; from a coarser one the second way alone is left
    // of it.
    if (!coarse) add(made_.second, 1.0, to_file);
    add(made_.second, -extrapolation, to_fine);
    // As it is, without a law of its order: its share is free in every fit.
    made_.first = change(by_junction, plain, at_file[0]);
    simulations_ += own_.simulations() + files.simulations();
  }

  NumericsCheck result(const Numerics& numerics) const {
    NumericsCheck check;
    check.numerics = numerics;
    check.corrections = made_;
    // Without the shift, which is corrected for where it arises, in the model. What is left of the
    // rest after the free parameters is what no fit can hide.
    const Eigen::VectorXd by_step = whitened(step_.rest), by_mesh = whitened(mesh_.rest);
    // Of the fitted trials: the Jacobian that parameters are taken out by has no others.
    const int samples = data_.samples(options_.trials, options_.horizon);
    check.by_step = rms(projected_out(base_.jacobian, by_step), samples);
    check.by_mesh = rms(projected_out(base_.jacobian, by_mesh), samples);
    // How far the numbers of this model would be off without the correction. What that may leave of
    // it widens their intervals.
    check.parameter_shift = believable_step(base_, by_step + by_mesh);
    for (int p = 0; p < check.parameter_shift.size(); ++p)
      for (std::size_t i = 0; i < Shift::count; ++i) {
        const FreeParameter& free = base_.hypothesis.free[p];
        // The rest moved them by its own step; the shift is of the factors themselves.
        if (free.name == "factor" &&
            base_.hypothesis.effects[free.effect].name == Shift::names()[i])
          check.parameter_shift[p] += made_.own.shift.logarithm[i];
      }
    // Of both together, with their signs: where they cancel the prediction is as good as it looks.
    check.correction = projected_out(base_.jacobian, by_step + by_mesh);
    check.largest = rms(check.correction, samples);
    return check;
  }
  long simulations() const { return simulations_; }

 private:
  std::vector<Predictions> run(Simulator& simulator, const std::vector<Shift>& shifts) const {
    return run_shifted(simulator, base_.hypothesis, shifts);
  }
  Predictions run(const Numerics& numerics) {
    Simulator simulator(experiment_, numerics, threads_, stop_);
    Predictions predicted = run(simulator, {Shift{}}).front();
    // This simulator goes at once; what it did is counted before.
    simulations_ += simulator.simulations();
    return predicted;
  }
  Eigen::VectorXd whitened(const Predictions& rest) const {
    // As a change about the model's own predictions, because the data set whitens residuals, with
    // their gaps and rates. The data themselves drop out of the difference.
    Predictions with = shift_.now();
    for (std::size_t t = 0; t < with.size(); ++t) {
      with[t].markers += rest[t].markers;
      with[t].force += rest[t].force;
      with[t].wrench += rest[t].wrench;
    }
    return shift_.change(with, shift_.now());
  }

  const Experiment& experiment_;
  const DataSet& data_;
  const FitSummary& base_;
  const FitOptions& options_;
  int threads_;
  const std::atomic<bool>* stop_;
  long simulations_ = 0;
  Simulator own_;
  ShiftFit shift_;
  Correction step_, mesh_;  // what the exact prediction has more
  Corrections made_;
};

}  // namespace

NumericsCheck check_numerics(const Experiment& experiment, const DataSet& data,
                             const FitSummary& base, const Numerics& numerics,
                             const FitOptions& options, int threads, long& simulations,
                             const std::atomic<bool>* stop) {
  const Comparison comparison(experiment, data, base, numerics, options, threads, stop);
  simulations += comparison.simulations();
  return comparison.result(numerics);
}

Numerics refined(const NumericsCheck& check) {
  Numerics finer = check.numerics;
  // Halving takes three quarters of an error. What is less than half of the other one would hardly
  // be felt, and doubles the time.
  if (check.by_step >= 0.5 * check.by_mesh) finer.dt *= 0.5;
  if (check.by_mesh >= 0.5 * check.by_step) finer.distance *= 0.5;
  return finer;
}

}  // namespace pedicel::discrepancy
