#include "app/help/manual_cells.h"

#include <cmath>

#include "engine/io/csv.h"

namespace pedicel::app {

std::string code(const std::string& text) {
  return "`" + text + "`";
}

std::string number_cell(double x) {
  return io::format_number(x, 6);
}

std::string phrase(std::string sentence) {
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

std::string range_cell(const io::Bounds& bounds) {
  const bool low = std::isfinite(bounds.minimum), high = std::isfinite(bounds.maximum);
  if (low && high && bounds.minimum == bounds.maximum) return number_cell(bounds.minimum);
  if (low && high)
    return bounds.open_minimum
               ? "above " + number_cell(bounds.minimum) + ", at most " + number_cell(bounds.maximum)
               : number_cell(bounds.minimum) + " to " + number_cell(bounds.maximum);
  if (low)
    return bounds.open_minimum ? "above " + number_cell(bounds.minimum)
                               : number_cell(bounds.minimum) + " or more";
  return "any number";
}

}  // namespace pedicel::app
