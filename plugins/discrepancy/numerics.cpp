#include "discrepancy/numerics.h"

#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr double extrapolation = 4.0 / 3.0;
constexpr double parameter_step = 0.005;  // of a logarithm
constexpr double usual_shift = 0.02;      // of a logarithm, by our own errors

// RMS per sample of a whitened vector.
double rms(const Eigen::VectorXd& v, int samples) {
  return samples > 0 ? v.norm() / std::sqrt(static_cast<double>(samples)) : 0.0;
}

using Predictions = std::vector<Prediction>;  // one a trial

// share (finer - coarser), added to what is there.
void add_difference(Predictions& sum, double share, const Predictions& finer,
                    const Predictions& coarser) {
  const bool first = sum.empty();
  if (first) sum.resize(finer.size());
  for (std::size_t t = 0; t < finer.size(); ++t) {
    const Eigen::MatrixXd markers = share * (finer[t].markers - coarser[t].markers);
    const Eigen::MatrixXd force = share * (finer[t].force - coarser[t].force);
    sum[t].markers = first ? markers : Eigen::MatrixXd(sum[t].markers + markers);
    sum[t].force = first ? force : Eigen::MatrixXd(sum[t].force + force);
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
        stop_(stop) {
    Numerics half_step = numerics, half_mesh = numerics, file_mesh = numerics;
    half_step.dt *= 0.5;
    half_mesh.distance *= 0.5;
    file_mesh.distance = experiment.plant.distance;
    Numerics plain_mesh = file_mesh;
    plain_mesh.junction = 0.0;
    Simulator own(experiment, numerics, threads, stop), files(experiment, file_mesh, threads, stop);
    now_ = run(own, {Shift{}}).front();
    measure_parameters(own);
    const Predictions step = run(half_step), mesh = run(half_mesh), plain = run(plain_mesh);
    const bool same = file_mesh.distance == numerics.distance;
    const Predictions file = same ? now_ : run(files, {Shift{}}).front();
    const Shift by_step = stands_for(step, now_), by_mesh = stands_for(mesh, now_),
                by_file = stands_for(file, now_), by_junction = stands_for(plain, file);
    const auto moved = run(own, {by_step, by_mesh, by_file});
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
    add_difference(first.rest, 1.0, plain, run(same ? own : files, {by_junction}).front());
    simulations_ += own.simulations() + files.simulations();
  }

  NumericsCheck result(const Numerics& numerics) const {
    NumericsCheck check;
    check.numerics = numerics;
    check.corrections = made_;
    const Eigen::VectorXd by_step = whitened(step_rest_), by_mesh = whitened(mesh_rest_);
    const int samples = data_.samples(options_.trials, options_.horizon);
    check.by_step = rms(left_over(base_.jacobian, by_step), samples);
    check.by_mesh = rms(left_over(base_.jacobian, by_mesh), samples);
    check.parameter_shift = absorbed(base_.jacobian, by_step + by_mesh);
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
    std::vector<Variant> variants;
    for (const Shift& shift : shifts) {
      variants.push_back(base_.hypothesis.variant());
      shift.apply(variants.back());
    }
    const int trials = static_cast<int>(experiment_.trials.size());
    std::vector<Simulator::Request> requests;
    for (const Variant& variant : variants)
      for (int t = 0; t < trials; ++t) requests.push_back({&variant, t});
    Predictions all = simulator.run(requests);
    std::vector<Predictions> result(shifts.size());
    for (std::size_t i = 0; i < all.size(); ++i) result[i / trials].push_back(std::move(all[i]));
    return result;
  }
  Predictions run(const Numerics& numerics) {
    Simulator simulator(experiment_, numerics, threads_, stop_);
    Predictions predicted = run(simulator, {Shift{}}).front();
    simulations_ += simulator.simulations();
    return predicted;
  }

  // Whitened change of the predictions by each parameter's logarithm.
  void measure_parameters(Simulator& simulator) {
    std::vector<Shift> steps(Shift::names.size());
    for (std::size_t i = 0; i < steps.size(); ++i) steps[i].logarithm[i] = parameter_step;
    const std::vector<Predictions> moved = run(simulator, steps);
    by_parameter_.resize(data_.size(options_.trials), static_cast<Eigen::Index>(steps.size()));
    for (std::size_t i = 0; i < steps.size(); ++i)
      by_parameter_.col(static_cast<Eigen::Index>(i)) = change(moved[i], now_) / parameter_step;
  }

  // The shift of the parameters that explains most of a change, held small where the data hardly
  // see it.
  Shift stands_for(const Predictions& finer, const Predictions& coarser) const {
    const Eigen::Matrix3d information = by_parameter_.transpose() * by_parameter_ +
                                        Eigen::Matrix3d::Identity() / (usual_shift * usual_shift);
    const Eigen::Vector3d found =
        information.ldlt().solve(by_parameter_.transpose() * change(finer, coarser));
    Shift shift;
    for (int i = 0; i < 3; ++i) shift.logarithm[i] = found[i];
    return shift;
  }

  Eigen::VectorXd change(const Predictions& finer, const Predictions& coarser) const {
    Eigen::VectorXd result(data_.size(options_.trials));
    Eigen::Index row = 0;
    for (const int t : options_.trials) {
      const int size = data_.size(std::span(&t, 1));
      Eigen::VectorXd coarse(size), fine(size);
      data_.residual(t, coarser[t], options_.horizon, coarse);
      data_.residual(t, finer[t], options_.horizon, fine);
      result.segment(row, size) = coarse - fine;
      row += size;
    }
    return result;
  }
  Eigen::VectorXd whitened(const Predictions& rest) const {
    Predictions with = now_;
    for (std::size_t t = 0; t < with.size(); ++t) {
      with[t].markers += rest[t].markers;
      with[t].force += rest[t].force;
    }
    return change(with, now_);
  }

  const Experiment& experiment_;
  const DataSet& data_;
  const FitSummary& base_;
  const FitOptions& options_;
  int threads_;
  const std::atomic<bool>* stop_;
  long simulations_ = 0;
  Predictions now_, step_rest_, mesh_rest_;
  Eigen::MatrixXd by_parameter_;
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
