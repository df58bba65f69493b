#include "discrepancy/numerics.h"

#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double extrapolation = 4.0 / 3.0;

// RMS per sample of a whitened vector.
double rms(const Eigen::VectorXd& v, int samples) {
  return samples > 0 ? v.norm() / std::sqrt(static_cast<double>(samples)) : 0.0;
}

Prediction difference(const Prediction& finer, const Prediction& coarser, double share) {
  Prediction change;
  change.markers = share * (finer.markers - coarser.markers);
  change.force = share * (finer.force - coarser.force);
  return change;
}

}  // namespace

NumericsCheck check_numerics(const Experiment& experiment, const DataSet& data,
                             const FitSummary& base, const Numerics& numerics,
                             const FitOptions& options, int threads, long& simulations,
                             const std::atomic<bool>* stop) {
  NumericsCheck check;
  check.numerics = numerics;
  FitOptions all = options;
  all.trials.clear();
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t) all.trials.push_back(t);
  const auto run = [&](const Numerics& with) {
    Simulator simulator(experiment, with, threads, stop);
    Evaluator evaluator(simulator, data);
    auto predicted = evaluator.predictions(std::span(&base.hypothesis, 1), all);
    simulations += simulator.simulations();
    return std::move(predicted.front());
  };
  Numerics half_step = numerics, half_mesh = numerics, file_mesh = numerics;
  half_step.dt *= 0.5;
  half_mesh.distance *= 0.5;
  file_mesh.distance = experiment.plant.distance;
  Numerics plain_mesh = file_mesh;
  plain_mesh.junction = 0.0;
  const auto now = run(numerics), step = run(half_step), mesh = run(half_mesh),
             plain = run(plain_mesh);
  const auto file = file_mesh.distance == numerics.distance ? now : run(file_mesh);
  const auto whitened = [&](const std::vector<Prediction>& finer) {
    Eigen::VectorXd change(data.size(options.trials));
    Eigen::Index row = 0;
    for (const int t : options.trials) {
      const int size = data.size(std::span(&t, 1));
      Eigen::VectorXd coarse(size), fine(size);
      data.residual(t, now[t], options.horizon, coarse);
      data.residual(t, finer[t], options.horizon, fine);
      change.segment(row, size) = coarse - fine;
      row += size;
    }
    return Eigen::VectorXd(extrapolation * change);
  };
  const Eigen::VectorXd by_step = whitened(step), by_mesh = whitened(mesh);
  const int samples = data.samples(options.trials, options.horizon);
  check.by_step = rms(left_over(base.jacobian, by_step), samples);
  check.by_mesh = rms(left_over(base.jacobian, by_mesh), samples);
  check.parameter_shift = absorbed(base.jacobian, by_step + by_mesh);
  check.correction = left_over(base.jacobian, by_step + by_mesh);
  check.largest = rms(check.correction, samples);
  for (std::size_t t = 0; t < now.size(); ++t) {
    const Prediction by_finer_mesh = difference(mesh[t], now[t], extrapolation);
    Prediction own = difference(step[t], now[t], extrapolation);
    own.markers += by_finer_mesh.markers;
    own.force += by_finer_mesh.force;
    Prediction second = difference(file[t], now[t], 1.0);
    second.markers -= by_finer_mesh.markers;
    second.force -= by_finer_mesh.force;
    check.corrections.own.push_back(std::move(own));
    check.corrections.first.push_back(difference(plain[t], file[t], 1.0));
    check.corrections.second.push_back(std::move(second));
  }
  return check;
}

Numerics refined(const NumericsCheck& check) {
  Numerics finer = check.numerics;
  if (check.by_step >= 0.5 * check.by_mesh) finer.dt *= 0.5;
  if (check.by_mesh >= 0.5 * check.by_step) finer.distance *= 0.5;
  return finer;
}

}  // namespace pedicel::discrepancy
