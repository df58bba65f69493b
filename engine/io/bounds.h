#pragma once

#include <limits>
#include <string>

namespace pedicel::io {

/// What a number read from a file must satisfy.
struct Bounds {
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool open_minimum = false;  ///< the minimum itself is refused
};
inline constexpr Bounds any_number{};
inline constexpr Bounds positive{0.0, std::numeric_limits<double>::infinity(), true};
inline constexpr Bounds not_negative{0.0};
inline constexpr Bounds fraction{0.0, 1.0};

bool within(double value, const Bounds& bounds);
/// "a number > 0", for what is said of a number that is not.
std::string bounds_text(const Bounds& bounds);

}  // namespace pedicel::io
