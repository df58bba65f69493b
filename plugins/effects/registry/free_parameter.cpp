#include "plugins/effects/registry/free_parameter.h"

#include <cmath>

namespace pedicel::effects {

double FreeParameter::width() const {
  constexpr double wide_factor = 1.5, wide_number = 3.0;
  if (prior > 0.0) return prior;
  return logarithmic ? wide_factor : wide_number;
}

double FreeParameter::to_unknown(double value) const {
  return logarithmic ? std::log(value) : value / scale;
}

double FreeParameter::to_value(double unknown) const {
  return logarithmic ? std::exp(unknown) : unknown * scale;
}

}  // namespace pedicel::effects
