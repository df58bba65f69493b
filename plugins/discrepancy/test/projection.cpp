#include "plugins/discrepancy/test/projection.h"

#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

// Samples after which noise of any correlation that the model allows has forgotten its past.
// Impulse responses of an autoregressive process never end. They are cut here.
constexpr int memory = 400;

// Of the scaled information: below it an unknown is left open.
constexpr double open = 1.0e-10;

// What is left of a column beside the multiple of `one` that fits it best (Frisch and Waugh,
// Econometrica 1, 1933: the other unknowns then come out as if it had been fitted along).
void take_out(const Eigen::VectorXd& one, Eigen::Ref<Eigen::VectorXd> column) {
  double product = 0.0, square = 0.0;
  for (Eigen::Index i = 0; i < one.size(); ++i)
    if (std::isfinite(column[i])) product += one[i] * column[i], square += one[i] * one[i];
  if (square > 0.0) column -= product / square * one;
}

}  // namespace

Projection::Projection(int unknowns)
    : information_(Eigen::MatrixXd::Zero(unknowns, unknowns)),
      right_(Eigen::VectorXd::Zero(unknowns)) {}

void Projection::add(const Series& residual, const Eigen::MatrixXd& regressors, const Noise& noise,
                     Constant constant) {
  Series r = residual;
  // A gap on one side is a gap on both: the filter must start afresh at the same sample for all
  // columns, or they would not be whitened alike.
  for (Eigen::Index i = 0; i < r.size(); ++i)
    if (!regressors.row(i).allFinite()) r[i] = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd white = whiten(r, noise);
  const auto with_gaps = [&](Series column) -> Eigen::VectorXd {
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (!std::isfinite(r[i])) column[i] = r[i];
    return whiten(column, noise);
  };
  Eigen::MatrixXd x(regressors.rows(), regressors.cols());
  // Aitken: residual and regressors go through the same filter. Then ordinary least squares of the
  // results has the least error, and its covariance is right.
  for (Eigen::Index c = 0; c < x.cols(); ++c) x.col(c) = with_gaps(regressors.col(c));
  if (constant == Constant::free) {
    // A constant is no constant any more once it is whitened: after each gap the filter starts
    // afresh, and makes another number of it.
    const Eigen::VectorXd one = with_gaps(Series::Ones(r.size()));
    take_out(one, white);
    for (auto column : x.colwise()) take_out(one, column);
    // It has taken one degree of freedom with it.
    --samples_;
  }
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (!std::isfinite(white[i])) continue;
    // Channels are added up and never kept: an experiment has many, and a projection has few
    // unknowns.
    information_ += x.row(i).transpose() * x.row(i);
    right_ += x.row(i).transpose() * white[i];
    squares_ += white[i] * white[i];
    ++samples_;
  }
}

bool Projection::solve(Result& result) const {
  const Eigen::VectorXd size = information_.diagonal().cwiseSqrt();
  // A regressor that is zero everywhere leaves its unknown open.
  if (size.size() == 0 || !(size.minCoeff() > 0.0) || samples_ <= size.size()) return false;
  // Unknowns are of different units, seconds and shares. Scaled to a diagonal of 1 the eigenvalues
  // say how far the columns are alike, and nothing of units.
  const Eigen::VectorXd scale = size.cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information_ * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  if (!(eigen.eigenvalues()[0] > open)) return false;
  const Eigen::MatrixXd inverse = eigen.eigenvectors() *
                                  eigen.eigenvalues().cwiseInverse().asDiagonal() *
                                  eigen.eigenvectors().transpose();
  result.covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
  result.value = result.covariance * right_;
  const double part = result.value.dot(right_);
  // The part of the whitened sum of squares that the regressors take.
  result.explained = squares_ > 0.0 ? part / squares_ : 0.0;
  const auto freedom = static_cast<double>(samples_ - size.size());
  // Not used to widen errors here. Who calls knows whether scatter is noise or another fault of the
  // model.
  result.scatter = std::sqrt(std::max(0.0, squares_ - part) / freedom);
  result.samples = samples_;
  return true;
}

Measured Projection::Result::component(int i) const {
  return {value[i], std::sqrt(covariance(i, i))};
}

Measured Projection::Result::length(int first, int count) const {
  const Eigen::VectorXd part = value.segment(first, count);
  const double size = part.norm();
  // Of no length there is no direction, and all of them count.
  if (size == 0.0) return {0.0, std::sqrt(covariance.block(first, first, count, count).trace())};
  const Eigen::VectorXd along = part / size;
  // To first order only the error along the vector changes its length.
  return {size, std::sqrt(along.dot(covariance.block(first, first, count, count) * along))};
}

Measured length_of(const Eigen::VectorXd& vector, const Eigen::VectorXd& errors) {
  const double size = vector.norm();
  if (size == 0.0) return {0.0, errors.norm()};
  return {size, (vector / size).cwiseProduct(errors).norm()};
}

// Noise is e_i = sum_k a_k e_(i-k) + s n_i with n white, so sum_i w_i e_i = s sum_j x_j n_j with x
// from the same recursion run backwards, x_j = w_j + sum_k a_k x_(j+k).
double projected_std(const Eigen::VectorXd& weights, const Noise& noise) {
  const int order = noise.order();
  const Eigen::Index past = order > 0 ? memory : 0;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(past + weights.size());
  x.tail(weights.size()) = weights;
  // Backwards in time, from the last weight: each innovation acts on all samples after it. The rows
  // before the first weight stand for the innovations before the record.
  for (Eigen::Index j = x.size() - 1; j >= 0; --j)
    for (int k = 0; k < order && j + 1 + k < x.size(); ++k)
      x[j] += noise.weights.back()[k] * x[j + 1 + k];
  return noise.innovation.back() * x.norm();
}

std::vector<double> autocorrelation(const Noise& noise, int lags) {
  const int order = noise.order();
  std::vector<double> response(memory + lags + 1, 0.0);
  response[0] = 1.0;
  for (int i = 1; i < static_cast<int>(response.size()); ++i)
    for (int k = 0; k < std::min(order, i); ++k)
      response[i] += noise.weights.back()[k] * response[i - 1 - k];
  std::vector<double> result(lags + 1, 0.0);
  for (int lag = 0; lag <= lags; ++lag)
    for (int i = 0; i < memory; ++i) result[lag] += response[i] * response[i + lag];
  // Downwards, so that the first one is divided last, by itself.
  for (int lag = lags; lag >= 0; --lag) result[lag] /= result[0];
  return result;
}

}  // namespace pedicel::discrepancy
