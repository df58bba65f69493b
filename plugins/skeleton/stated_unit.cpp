#include "plugins/skeleton/stated_unit.h"

#include <cmath>

#include "engine/io/unit_text.h"

namespace pedicel::plant {

double in_metres(double length, double unit) {
  const double parts = std::round(1.0 / unit);
  return unit < 1.0 && std::abs(parts * unit - 1.0) < 1.0e-12 ? length / parts : length * unit;
}

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

double StatedLengthUnit::of_column(const std::string& name, const std::string& text,
                                   const SourcePosition& where) const {
  if (text.empty()) return unit_;
  const auto unit = io::unit_of(text);
  if (!unit || unit->quantity != io::Quantity::length) {
    diagnostics_.error(where, "column " + in_quotes(name) + " is in " + in_quotes(text) +
                                  ", expected " + io::units_of(io::Quantity::length));
    return 1.0;
  }
  if (asked_ > 0.0 && asked_ != unit->factor)
    diagnostics_.error(where, "column " + in_quotes(name) + " is in " + text + ", and " +
                                  io::length_unit_name(asked_) +
                                  " was asked for: expected one of them");
  return unit->factor;
}

}  // namespace pedicel::plant
