#include "discrepancy/identifiability.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::hidden {

namespace {

void append(const Eigen::MatrixXd& samples, double std, double rho, std::vector<double>& out) {
  const double innovation = std * std::sqrt(1.0 - rho * rho);
  for (int c = 0; c < samples.cols(); ++c)
    for (int i = 0; i < samples.rows(); ++i)
      out.push_back(i == 0 ? samples(0, c) / std
                           : (samples(i, c) - rho * samples(i - 1, c)) / innovation);
}

}  // namespace

Eigen::VectorXd whitened(const std::vector<reference::Record>& records, const Noise& noise) {
  std::vector<double> all;
  for (const reference::Record& r : records) {
    append(r.markers, noise.position_std, noise.rho, all);
    append(r.force, noise.force_std, 0.0, all);
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
    : predict_(std::move(predict)), absorbing_(std::move(absorbing)), plain_(predict_(subject)) {
  const double step = 0.003;
  columns_.resize(plain_.size(), static_cast<Eigen::Index>(absorbing_.size()));
  for (int k = 0; k < columns_.cols(); ++k) {
    reference::Subject changed = subject;
    changed.effects.push_back(factor(absorbing_[k], std::exp(step)));
    columns_.col(k) = (predict_(changed) - plain_) / step;
  }
  // A direction that the others contain but for rounding stays out; one that they nearly contain is
  // what a refit follows far.
  if (columns_.cols() == 0) return;
  qr_.setThreshold(1e-6);
  qr_.compute(columns_);
}

Sight::Change Sight::change(const reference::Subject& with, const Eigen::VectorXd& start) const {
  Change out;
  out.refit = start.size() ? start : Eigen::VectorXd::Zero(columns_.cols());
  for (int k = 0; k < 10; ++k) {
    reference::Subject changed = with;
    for (std::size_t i = 0; i < absorbing_.size(); ++i)
      changed.effects.push_back(factor(absorbing_[i], std::exp(out.refit[static_cast<int>(i)])));
    out.rest = predict_(changed) - plain_;
    if (columns_.cols() == 0) break;
    const Eigen::VectorXd step = qr_.solve(out.rest);
    out.rest -= columns_ * step;
    // Where what the line promises is small against what is left it may be believed.
    if ((columns_ * step).norm() < 0.3 * out.rest.norm() || step.cwiseAbs().maxCoeff() < 1e-4)
      break;
    out.refit -= step.cwiseMax(-0.3).cwiseMin(0.3);
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
