#include "pedicel/discrepancy/fit/shift_fit.h"

namespace pedicel::discrepancy {

void add_difference(Predictions& sum, double share, const Predictions& to,
                    const Predictions& from) {
  const bool first = sum.empty();
  if (first) sum.resize(to.size());
  for (std::size_t t = 0; t < to.size(); ++t) {
    const Eigen::MatrixXd markers = share * (to[t].markers - from[t].markers);
    const Eigen::MatrixXd force = share * (to[t].force - from[t].force);
    sum[t].markers = first ? markers : Eigen::MatrixXd(sum[t].markers + markers);
    sum[t].force = first ? force : Eigen::MatrixXd(sum[t].force + force);
    const Eigen::MatrixXd wrench = share * (to[t].wrench - from[t].wrench);
    sum[t].wrench = first ? wrench : Eigen::MatrixXd(sum[t].wrench + wrench);
  }
}

std::vector<Predictions> run_shifted(Simulator& simulator, const Hypothesis& model,
                                     std::span<const Shift> shifts) {
  std::vector<Variant> variants;
  for (const Shift& shift : shifts) {
    variants.push_back(model.variant());
    shift.apply(variants.back());
  }
  const int trials = static_cast<int>(simulator.experiment().trials.size());
  std::vector<Simulator::Request> requests;
  for (const Variant& variant : variants)
    for (int t = 0; t < trials; ++t) requests.push_back({&variant, t});
  Predictions all = simulator.run(requests);
  std::vector<Predictions> result(shifts.size());
  for (std::size_t i = 0; i < all.size(); ++i) result[i / trials].push_back(std::move(all[i]));
  return result;
}

ShiftFit::ShiftFit(Simulator& simulator, const DataSet& data, const Hypothesis& model,
                   const Shift& own, const FitOptions& options)
    : data_(data), options_(options) {
  const double step = options.settings->accuracy.shift_step;
  std::vector<Shift> shifts(Shift::count + 1, own);
  for (std::size_t i = 0; i < Shift::count; ++i) shifts[i + 1].logarithm[i] += step;
  std::vector<Predictions> moved = run_shifted(simulator, model, shifts);
  now_ = std::move(moved.front());
  by_parameter_.resize(data.size(options.trials), Shift::count);
  for (std::size_t i = 0; i < Shift::count; ++i)
    by_parameter_.col(static_cast<Eigen::Index>(i)) = change(moved[i + 1], now_) / step;
}

Eigen::VectorXd ShiftFit::change(const Predictions& to, const Predictions& from) const {
  Eigen::VectorXd result(data_.size(options_.trials));
  Eigen::Index row = 0;
  for (const int t : options_.trials) {
    const int size = data_.size(std::span(&t, 1));
    Eigen::VectorXd before(size), after(size);
    data_.residual(t, from[t], options_.horizon, before);
    data_.residual(t, to[t], options_.horizon, after);
    result.segment(row, size) = before - after;
    row += size;
  }
  return result;
}

Shift ShiftFit::stands_for(const Predictions& to, const Predictions& from) const {
  const double usual = options_.settings->accuracy.usual_shift;
  using Square = Eigen::Matrix<double, Shift::count, Shift::count>;
  const Square information =
      by_parameter_.transpose() * by_parameter_ + Square::Identity() / (usual * usual);
  const Eigen::Vector<double, Shift::count> found =
      information.ldlt().solve(by_parameter_.transpose() * change(to, from));
  Shift shift;
  for (int i = 0; i < Shift::count; ++i) shift.logarithm[i] = found[i];
  return shift;
}

}  // namespace pedicel::discrepancy
