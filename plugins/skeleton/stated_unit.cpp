#include "plugins/skeleton/stated_unit.h"

#include <cmath>

#include "engine/io/unit_text.h"

namespace pedicel::plant {

void StatedLengthUnit::take(const std::string& text, int line) {
  if (text.empty()) return;
  const std::optional<double> unit = io::length_unit(text);
  if (!unit)
    diagnostics_.error({file_, line, 1},
                       "unit is " + in_quotes(text) + ", expected " + io::expected_length_units());
  else if (asked_ > 0.0 && asked_ != *unit)
    diagnostics_.error({file_, line, 1},
                       "the file says that it is in " + io::length_unit_name(*unit) + ", and " +
                           io::length_unit_name(asked_) + " was asked for: expected one of them");
  else
    unit_ = *unit;
}

double StatedLengthUnit::metres(double length) const {
  const double parts = std::round(1.0 / unit_);
  return unit_ < 1.0 && std::abs(parts * unit_ - 1.0) < 1.0e-12 ? length / parts : length * unit_;
}

}  // namespace pedicel::plant
