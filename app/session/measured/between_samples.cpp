#include "app/session/measured/between_samples.h"

#include <algorithm>

namespace pedicel::app {

Eigen::RowVectorXd BetweenSamples::row(const Eigen::MatrixXd& table) const {
  if (share == 0.0) return table.row(low);
  return table.row(low) + share * (table.row(high) - table.row(low));
}

BetweenSamples between_samples(const std::vector<double>& time, double t) {
  const auto above = std::upper_bound(time.begin(), time.end(), t);
  if (above == time.begin()) return {};
  const auto high = static_cast<Eigen::Index>(above - time.begin());
  if (above == time.end()) return {high - 1, high - 1, 0.0};
  const double before = *(above - 1);
  return {high - 1, high, (t - before) / (*above - before)};
}

}  // namespace pedicel::app
