#include "tests/discrepancy/identifiability.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::hidden {

namespace {

constexpr int most_steps = 30;
constexpr double longest_step = 0.3;  // of a factor's logarithm

void append(const Eigen::MatrixXd& samples, double std, double rho, std::vector<double>& out) {
  const double innovation = std * std::sqrt(1.0 - rho * rho);
  for (int c = 0; c < samples.cols(); ++c)
    for (int i = 0; i < samples.rows(); ++i)
      out.push_back(i == 0 ? samples(0, c) / std
                           : (samples(i, c) - rho * samples(i - 1, c)) / innovation);
}

/// The least squares step on residual - columns step, its columns weighed down by `damping`, none
/// of its entries above longest_step.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& columns, const Eigen::VectorXd& residual,
                            double damping) {
  Eigen::MatrixXd normal = columns.transpose() * columns;
  normal.diagonal() *= 1.0 + damping;
  // A direction that the others contain but for rounding stays out; one that they nearly contain is
  // what a refit follows far.
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(1e-10);
  qr.compute(normal);
  const Eigen::VectorXd step = qr.solve(columns.transpose() * residual);
  return step * std::min(1.0, longest_step / step.cwiseAbs().maxCoeff());
}

}  // namespace

Eigen::VectorXd whitened(const std::vector<reference::Record>& records, const Noise& noise) {
  std::vector<double> all;
  for (const reference::Record& r : records) {
    append(r.markers, noise.position_std, noise.rho, all);
    append(r.force, noise.force_std, 0.0, all);
    if (r.wrench.rows() == 0) continue;
    append(r.wrench.leftCols(3), noise.force_std, 0.0, all);
    append(r.wrench.rightCols(3), noise.moment_std, 0.0, all);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

plant::Effect factor(const std::string& parameter, double value) {
  plant::Effect e;
  e.name = parameter;
  e.numbers["factor"] = {value};
  return e;
}

Sight::Sight(const reference::Subject& subject, Predict predict, std::vector<std::string> absorbing)
    : subject_(subject),
      predict_(std::move(predict)),
      absorbing_(std::move(absorbing)),
      plain_(predict_(subject)),
      columns_(changes_by_factors(Eigen::VectorXd::Zero(factors()))) {}

Eigen::VectorXd Sight::refitted(const Eigen::VectorXd& refit) const {
  reference::Subject subject = subject_;
  for (int i = 0; i < factors(); ++i)
    subject.effects.push_back(factor(absorbing_[i], std::exp(refit[i])));
  return predict_(subject);
}

Eigen::MatrixXd Sight::changes_by_factors(const Eigen::VectorXd& refit) const {
  const double step = 0.003;
  Eigen::MatrixXd columns(plain_.size(), factors());
  const auto place = [&](const char* name) {
    return std::find(absorbing_.begin(), absorbing_.end(), name) - absorbing_.begin();
  };
  const auto modulus = place("youngs_modulus"), density = place("density");
  const bool both = std::max(modulus, density) < factors();
  for (int i = 0; i < factors(); ++i) {
    // A swing sees little but modulus over density: what both do together is looked at itself, not
    // as the sum of two large changes.
    Eigen::VectorXd along = step * Eigen::VectorXd::Unit(factors(), i);
    if (both && i == density) along[modulus] = step;
    columns.col(i) = (refitted(refit + along) - refitted(refit - along)) / (2.0 * step);
  }
  if (both) columns.col(density) -= columns.col(modulus);
  return columns;
}

Sight::Change Sight::change(const reference::Subject& with, const Eigen::VectorXd& start) const {
  Change out;
  out.refit = start.size() ? start : Eigen::VectorXd::Zero(factors());
  const Eigen::VectorXd data = predict_(with);
  Eigen::VectorXd here = start.size() ? refitted(start) : plain_;
  if (!here.allFinite() || (data - plain_).squaredNorm() < (data - here).squaredNorm()) {
    out.refit.setZero();
    here = plain_;
  }
  out.rest = data - here;
  if (factors() == 0) return out;
  Eigen::MatrixXd columns = columns_;
  bool fresh = out.refit.isZero();  // whether the columns were taken here
  double damping = 0.0;             // Levenberg's
  for (int k = 0; k < most_steps; ++k) {
    const Eigen::VectorXd step = damped_step(columns, out.rest, damping);
    const Eigen::VectorXd promised = columns * step;
    // What the line promises may be believed where it is small against what is left.
    if (promised.norm() < 0.1 * (out.rest - promised).norm()) {
      if (fresh) {
        out.rest -= columns * damped_step(columns, out.rest, 0.0);
        break;
      }
      columns = changes_by_factors(out.refit);
      fresh = true;
      continue;
    }
    const Eigen::VectorXd there = refitted(out.refit + step);
    if (there.allFinite() && (data - there).squaredNorm() < out.rest.squaredNorm()) {
      // Broyden's update: the columns that would have told this change.
      columns += (there - here - promised) * step.transpose() / step.squaredNorm();
      out.refit += step;
      here = there;
      out.rest = data - here;
      fresh = false;
      damping *= 0.1;
    } else if (!fresh) {
      columns = changes_by_factors(out.refit);
      fresh = true;
    } else {
      damping = std::max(10.0 * damping, 1e-4);
    }
  }
  return out;
}

double sine(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd u = a.normalized();
  return (b - u * u.dot(b)).norm() / b.norm();
}

double size_for(const std::function<double(double)>& norm, double level, double guess, double cap) {
  double size = std::min(guess, cap), exponent = 1.0, last_size = 0.0, last_norm = 0.0;
  double low = 0.0, high = std::numeric_limits<double>::infinity();  // too small, too large
  for (int k = 0; k < 20; ++k) {
    const double now = norm(size);
    if (std::abs(now / level - 1.0) < 0.05 || (size == cap && now < level)) return size;
    (now < level ? low : high) = size;
    if (last_size > 0.0 && now > 0.0 && last_norm > 0.0)
      exponent = std::clamp(std::log(now / last_norm) / std::log(size / last_size), 0.3, 4.0);
    last_size = size;
    last_norm = now;
    const double ratio = now > 0.0 ? std::pow(level / now, 1.0 / exponent) : 4.0;
    size = std::min(size * std::clamp(ratio, 0.02, 20.0), cap);
    // A step that leaves what is known to hold the answer is no better than the middle.
    if (size <= low || size >= high) size = low > 0.0 ? std::sqrt(low * high) : 0.1 * high;
  }
  return size;
}

}  // namespace pedicel::hidden
