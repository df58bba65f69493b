#include "plugins/discrepancy/simulate/differences.h"

#include <algorithm>
#include <utility>

namespace pedicel::discrepancy {

using plant::MaterialRole;

namespace {

constexpr double most_over = 2.5;  // of the size wanted

}  // namespace

Differences::Differences(const Hypothesis& model, DifferenceRule rule)
    : rule_(std::move(rule)),
      model_(model),
      modulus_(model.factor_on(MaterialRole::stiffness)),
      density_(model.factor_on(MaterialRole::mass)),
      directions_(Eigen::MatrixXd::Identity(model.size(), model.size())),
      size_(Eigen::VectorXd::Constant(model.size(), rule_.first)) {
  for (int p = 0; p < model.size(); ++p) size_[p] = std::max(size_[p], least(p));
  step_ = size_;
  if (modulus_ < 0 || !rule_.pairs) density_ = -1;
  if (density_ >= 0) directions_(modulus_, density_) = 1.0;
}

Differences::Differences(const Hypothesis& model, const Eigen::MatrixXd& jacobian,
                         DifferenceRule rule)
    : Differences(model, std::move(rule)) {
  const Eigen::Index known = jacobian.cols();
  Eigen::MatrixXd along = jacobian * directions_.topLeftCorner(known, known);
  resize(along);
}

std::vector<Hypothesis> Differences::points(const Eigen::VectorXd& unknowns) {
  std::vector<Hypothesis> moved(model_.size() + 1, model_);
  moved[0].set_unknowns(unknowns);
  const Eigen::VectorXd high = model_.high();
  for (int p = 0; p < model_.size(); ++p) {
    const Eigen::VectorXd up = unknowns + size_[p] * directions_.col(p);
    step_[p] = (up.array() > high.array()).any() ? -size_[p] : size_[p];
    moved[p + 1].set_unknowns(unknowns + step_[p] * directions_.col(p));
  }
  return moved;
}

Eigen::MatrixXd Differences::jacobian(const Eigen::MatrixXd& residuals) {
  Eigen::MatrixXd along(residuals.rows(), model_.size());
  for (int p = 0; p < model_.size(); ++p)
    along.col(p) = (residuals.col(0) - residuals.col(p + 1)) / step_[p];
  resize(along);
  if (density_ >= 0) along.col(density_) -= along.col(modulus_);
  return along;
}

bool Differences::suited() const {
  const Eigen::ArrayXd over = step_.array().abs() / size_.array();
  return (over < most_over).all() && (over > 1.0 / most_over).all();
}

// Those beyond the columns that are known keep their sizes.
void Differences::resize(const Eigen::MatrixXd& along) {
  for (int p = 0; p < static_cast<int>(along.cols()); ++p) {
    // A number that shows nothing would get a step without end.
    const double wanted = rule_.wanted_change / std::max(along.col(p).norm(), 1.0e-12);
    const double near =
        std::clamp(wanted, size_[p] / rule_.most_growth, size_[p] * rule_.most_growth);
    size_[p] = std::clamp(near, least(p), std::max(least(p), rule_.most));
  }
}

}  // namespace pedicel::discrepancy
