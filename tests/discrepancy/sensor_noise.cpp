#include "tests/discrepancy/sensor_noise.h"

#include <algorithm>
#include <cmath>

#include "engine/core/frames.h"

namespace pedicel::hidden {

void add_noise(Eigen::MatrixXd& samples, double std, double rho, Random& random) {
  const double fresh = std * std::sqrt(1 - rho * rho);
  for (int c = 0; c < samples.cols(); ++c) {
    double n = std * random.normal();
    for (int i = 0; i < samples.rows(); ++i) {
      if (i > 0) n = rho * n + fresh * random.normal();
      samples(i, c) += n;
    }
  }
}

void add_outliers(Eigen::MatrixXd& markers, const std::vector<plant::Effect>& effects,
                  double position_std, Random& random) {
  for (const plant::Effect& e : effects) {
    if (e.name != "outliers") continue;
    for (int i = 0; i < markers.rows(); ++i)
      for (int m = 0; m < markers.cols() / 3; ++m) {
        if (random.uniform() >= e.number("fraction")) continue;
        Vec3 away(random.normal(), random.normal(), random.normal());
        away *= random.uniform(15, 40) * position_std / std::max(away.norm(), 0.1);
        markers.block<1, 3>(i, 3 * m) += away.transpose();
      }
  }
}

}  // namespace pedicel::hidden
