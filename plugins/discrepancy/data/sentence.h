#pragma once

#include <cstdio>
#include <string>

namespace pedicel::discrepancy {

/// A short sentence with one or two numbers in it, as printf writes them.
inline std::string text(const char* format, double a, double b = 0.0) {
  char buffer[200];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

}  // namespace pedicel::discrepancy
