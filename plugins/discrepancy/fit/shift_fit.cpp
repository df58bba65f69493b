#include "plugins/discrepancy/fit/shift_fit.h"

namespace pedicel::discrepancy {

void add_difference(Predictions& sum, double share, const Predictions& to,
                    const Predictions& from) {
  // An empty sum has no sizes yet. They are those of each trial's own tables.
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
    // On top of what the model says of the three: its own factors and the shift multiply.
    shift.apply(variants.back());
  }
  // Held-out trials, too: our own error is corrected for in all of them alike.
  const int trials = static_cast<int>(simulator.experiment().trials.size());
  std::vector<Simulator::Request> requests;
  for (const Variant& variant : variants)
    for (int t = 0; t < trials; ++t) requests.push_back({&variant, t});
  // In one call, so that shifts and trials together fill the solver's lanes and all threads.
  Predictions all = simulator.run(requests);
  std::vector<Predictions> result(shifts.size());
  for (std::size_t i = 0; i < all.size(); ++i) result[i / trials].push_back(std::move(all[i]));
  return result;
}

ShiftFit::ShiftFit(Simulator& simulator, const DataSet& data, const Hypothesis& model,
                   const Shift& own, const FitOptions& options)
    : data_(data), options_(options) {
  // To one side. It need not be exact: whoever uses the shift simulates with it, and adds what it
  // still lacks.
  const double step = options.settings->accuracy.shift_step;
  // All of them, fitted or not: a number that is held in the model is still what a coarse mesh gets
  // wrong.
  std::vector<Shift> shifts(Shift::count + 1, own);
  for (std::size_t i = 0; i < Shift::count; ++i) shifts[i + 1].logarithm[i] += step;
  std::vector<Predictions> moved = run_shifted(simulator, model, shifts);
  // About the shift that is there already, as predictions of the model are.
  now_ = std::move(moved.front());
  by_parameter_.resize(data.size(options.trials), Shift::count);
  for (std::size_t i = 0; i < Shift::count; ++i)
    // Whitened, so that what a shift explains is counted in noise units, as everything else is.
    by_parameter_.col(static_cast<Eigen::Index>(i)) = change(moved[i + 1], now_) / step;
}

Eigen::VectorXd ShiftFit::change(const Predictions& to, const Predictions& from) const {
  // Of the fitted trials alone, so that what is held out has no say in it.
  Eigen::VectorXd result(data_.size(options_.trials));
  Eigen::Index row = 0;
  for (const int t : options_.trials) {
    const int size = data_.size(std::span(&t, 1));
    Eigen::VectorXd before(size), after(size);
    // Both with one horizon and one noise, or their difference would tell these.
    data_.residual(t, from[t], options_.horizon, before);
    data_.residual(t, to[t], options_.horizon, after);
    // The data drop out. Their gaps, rates and noise stay, which is why the way goes through
    // residuals.
    result.segment(row, size) = before - after;
    row += size;
  }
  return result;
}

Shift ShiftFit::stands_for(const Predictions& to, const Predictions& from) const {
  // A free swing sees modulus over density alone. Bare least squares would find any large pair of
  // both for a small change of the period, and put it into statics, where it is wrong.
  const double usual = options_.settings->accuracy.usual_shift;
  using Square = Eigen::Matrix<double, Shift::count, Shift::count>;
  const Square information =
      by_parameter_.transpose() * by_parameter_ + Square::Identity() / (usual * usual);
  // Normal equations do here: what was added to their diagonal bounds their condition.
  const Eigen::Vector<double, Shift::count> found =
      information.ldlt().solve(by_parameter_.transpose() * change(to, from));
  Shift shift;
  for (int i = 0; i < Shift::count; ++i) shift.logarithm[i] = found[i];
  return shift;
}

}  // namespace pedicel::discrepancy
