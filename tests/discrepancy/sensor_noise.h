#pragma once

#include <Eigen/Dense>

#include "engine/core/random.h"
#include "plugins/plant/effect_reader.h"

namespace pedicel::hidden {

/// Adds to every column AR(1) noise of deviation `std`, x_i = rho x_i-1 + e_i.
void add_noise(Eigen::MatrixXd& samples, double std, double rho, Random& random);

/// What `outliers` among the effects does to the markers (samples x 3 markers, m): one that is
/// taken for something else is 15 to 40 times `position_std` away for one sample.
void add_outliers(Eigen::MatrixXd& markers, const std::vector<plant::Effect>& effects,
                  double position_std, Random& random);

}  // namespace pedicel::hidden
