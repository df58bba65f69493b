#include "plugins/discrepancy/data/path_smoothing.h"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Of the weight on the second differences. Beyond the last a path is a straight line.
constexpr double least_weight = 1.0e-4, most_weight = 1.0e12;
constexpr int halvings = 40;

// Second divided differences, in units of the mean step.
Sparse second_differences(const std::vector<double>& time) {
  const auto n = static_cast<Eigen::Index>(time.size());
  const double step = (time.back() - time.front()) / static_cast<double>(n - 1);
  Sparse d(n - 2, n);
  for (Eigen::Index i = 0; i + 2 < n; ++i) {
    const double a = (time[i + 1] - time[i]) / step, b = (time[i + 2] - time[i + 1]) / step;
    d.insert(i, i) = 2.0 / (a * (a + b));
    d.insert(i, i + 1) = -2.0 / (a * b);
    d.insert(i, i + 2) = 2.0 / (b * (a + b));
  }
  return d;
}

Eigen::MatrixXd smooth(const Sparse& roughness, const Eigen::MatrixXd& rows, double weight) {
  Sparse identity(rows.rows(), rows.rows());
  identity.setIdentity();
  const Eigen::SimplicialLDLT<Sparse> solver(identity + weight * roughness);
  return solver.solve(rows);
}

}  // namespace

DrivenPath smoothed(const DrivenPath& path, double std) {
  if (path.time.size() < 4) return path;
  Eigen::MatrixXd rows(path.time.size(), 3);
  for (std::size_t i = 0; i < path.time.size(); ++i)
    rows.row(static_cast<Eigen::Index>(i)) = path.position[i].transpose();
  const Sparse differences = second_differences(path.time);
  const Sparse roughness = differences.transpose() * differences;
  const auto off = [&](const Eigen::MatrixXd& found) {
    return std::sqrt((found - rows).squaredNorm() / static_cast<double>(rows.size()));
  };
  // What is off grows with the weight.
  double low = std::log(least_weight), high = std::log(most_weight);
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (off(smooth(roughness, rows, std::exp(middle))) > std ? high : low) = middle;
  }
  const Eigen::MatrixXd found = smooth(roughness, rows, std::exp(low));
  DrivenPath result = path;
  for (std::size_t i = 0; i < path.time.size(); ++i)
    result.position[i] = found.row(static_cast<Eigen::Index>(i)).transpose();
  return result;
}

std::optional<Experiment> with_smooth_paths(const Experiment& given) {
  if (!given.noise.path_std) return std::nullopt;
  Experiment experiment = given;
  for (Trial& trial : experiment.trials) {
    if (trial.is_static) continue;
    for (Hold& hold : trial.holds) hold.path = smoothed(hold.path, *given.noise.path_std);
    if (trial.base) trial.base = smoothed(*trial.base, *given.noise.path_std);
  }
  return experiment;
}

}  // namespace pedicel::discrepancy
