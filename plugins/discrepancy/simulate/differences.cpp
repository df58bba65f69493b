#include "plugins/discrepancy/simulate/differences.h"

#include <algorithm>

namespace pedicel::discrepancy {

using plant::MaterialRole;

namespace {

// Noise units. In a narrow valley two columns that are alike but for a hundredth are compared, and
// the second order of a swing's phase counts: with 5 a gradient's fit ended up to 3 nats above its
// minimum, with 0.3 within 0.1 of it and in half the steps. With 0.05 what Newton leaves is seen.
constexpr double wanted_change = 0.3;
constexpr double most_over = 2.5;  // of the size wanted
constexpr double first_size = 0.01, least_size = 1.0e-6, most_size = 0.05;

}  // namespace

Differences::Differences(const Hypothesis& model)
    : model_(model),
      modulus_(model.factor_on(MaterialRole::stiffness)),
      density_(model.factor_on(MaterialRole::mass)),
      directions_(Eigen::MatrixXd::Identity(model.size(), model.size())),
      size_(Eigen::VectorXd::Constant(model.size(), first_size)),
      step_(size_) {
  if (modulus_ < 0) density_ = -1;
  if (density_ >= 0) directions_(modulus_, density_) = 1.0;
}

Differences::Differences(const Hypothesis& model, const Eigen::MatrixXd& jacobian)
    : Differences(model) {
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
  for (int p = 0; p < static_cast<int>(along.cols()); ++p)
    size_[p] =
        std::clamp(wanted_change / std::max(along.col(p).norm(), 1.0e-12), least_size, most_size);
}

}  // namespace pedicel::discrepancy
