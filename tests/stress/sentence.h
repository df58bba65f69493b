#pragma once

#include <cstdio>
#include <string>

namespace pedicel::stress {

/// printf into a string.
template <class... Values>
std::string sentence(const char* format, Values... values) {
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(length, ' ');
  std::snprintf(text.data(), length + 1, format, values...);
  return text;
}

}  // namespace pedicel::stress
