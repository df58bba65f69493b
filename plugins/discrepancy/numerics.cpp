#include "discrepancy/numerics.h"

#include <cmath>

#include "discrepancy/shift_fit.h"

namespace pedicel::discrepancy {

namespace {

constexpr double extrapolation = 4.0 / 3.0;
// RMS per sample of a whitened vector.
double rms(const Eigen::VectorXd& v, int samples) {
  return samples > 0 ? v.norm() / std::sqrt(static_cast<double>(samples)) : 0.0;
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
        own_(experiment, numerics, threads, stop),
        shift_(own_, data, base.hypothesis, Shift{}, options) {
    Numerics half_step = numerics, half_mesh = numerics, file_mesh = numerics;
    half_step.dt *= 0.5;
    half_mesh.distance *= 0.5;
    file_mesh.distance = experiment.plant.distance;
    Numerics plain_mesh = file_mesh;
    plain_mesh.junction = 0.0;
    const bool same = file_mesh.distance == numerics.distance;
    Simulator files(experiment, file_mesh, threads, stop);
    const Predictions& now = shift_.now();
    const Predictions step = run(half_step), mesh = run(half_mesh), plain = run(plain_mesh);
    const Predictions file = same ? now : run(files, {Shift{}}).front();
    const Shift by_step = shift_.stands_for(step, now), by_mesh = shift_.stands_for(mesh, now),
                by_file = shift_.stands_for(file, now),
                by_junction = shift_.stands_for(plain, file);
    const auto moved = run(own_, {by_step, by_mesh, by_file});
    add_difference(step_rest_, extrapolation, step, moved[0]);
    add_difference(mesh_rest_, extrapolation, mesh, moved[1]);
    Correction &own_error = made_.own, &second = made_.second, &first = made_.first;
    own_error.shift.add(extrapolation, by_step);
    own_error.shift.add(extrapolation, by_mesh);
    add_difference(own_error.rest, extrapolation, step, moved[0]);
    add_difference(own_error.rest, extrapolation, mesh, moved[1]);
    second.shift.add(1.0, by_file);
    second.shift.add(-extrapolation, by_mesh);
    add_difference(second.rest, 1.0, file, moved[2]);
    add_difference(second.rest, -extrapolation, mesh, moved[1]);
    first.shift = by_junction;
    add_difference(first.rest, 1.0, plain, run(same ? own_ : files, {by_junction}).front());
    simulations_ += own_.simulations() + files.simulations();
  }

  NumericsCheck result(const Numerics& numerics) const {
    NumericsCheck check;
    check.numerics = numerics;
    check.corrections = made_;
    const Eigen::VectorXd by_step = whitened(step_rest_), by_mesh = whitened(mesh_rest_);
    const int samples = data_.samples(options_.trials, options_.horizon);
    check.by_step = rms(left_over(base_.jacobian, by_step), samples);
    check.by_mesh = rms(left_over(base_.jacobian, by_mesh), samples);
    check.parameter_shift = believable_step(base_, by_step + by_mesh);
    for (int p = 0; p < check.parameter_shift.size(); ++p)
      for (std::size_t i = 0; i < Shift::names.size(); ++i) {
        const FreeParameter& free = base_.hypothesis.free[p];
        if (free.name == "factor" && base_.hypothesis.effects[free.effect].name == Shift::names[i])
          check.parameter_shift[p] += made_.own.shift.logarithm[i];
      }
    check.correction = left_over(base_.jacobian, by_step + by_mesh);
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
    simulations_ += simulator.simulations();
    return predicted;
  }
  Eigen::VectorXd whitened(const Predictions& rest) const {
    Predictions with = shift_.now();
    for (std::size_t t = 0; t < with.size(); ++t) {
      with[t].markers += rest[t].markers;
      with[t].force += rest[t].force;
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
  Predictions step_rest_, mesh_rest_;
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
  if (check.by_step >= 0.5 * check.by_mesh) finer.dt *= 0.5;
  if (check.by_mesh >= 0.5 * check.by_step) finer.distance *= 0.5;
  return finer;
}

}  // namespace pedicel::discrepancy
