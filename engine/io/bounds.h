#pragma once

#include <string>

#include "io/yaml.h"

namespace pedicel::io {

bool within(double value, const Bounds& bounds);
/// "a number > 0", for what is said of a number that is not.
std::string bounds_text(const Bounds& bounds);

}  // namespace pedicel::io
