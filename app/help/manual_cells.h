#pragma once

#include <string>

#include "engine/io/bounds.h"

/// Cells of the manual's tables, as Markdown.
namespace pedicel::app {

/// `text`
std::string code(const std::string& text);
/// With six digits at most.
std::string number_cell(double x);
/// A sentence as the last cell of a row: a phrase without its full stop.
std::string phrase(std::string sentence);
/// "above 0", "0 to 1", "any number"
std::string range_cell(const io::Bounds& bounds);

}  // namespace pedicel::app
