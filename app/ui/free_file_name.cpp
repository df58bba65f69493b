#include "app/ui/free_file_name.h"

#include <array>
#include <cstdio>

namespace pedicel::app {

std::filesystem::path free_file_name(const std::string& stem, const std::string& ending) {
  for (int number = 1; number < 10000; ++number) {
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), "%03d", number);
    std::filesystem::path path = stem + "_" + digits.data() + ending;
    if (!std::filesystem::exists(path)) return path;
  }
  return stem + ending;
}

}  // namespace pedicel::app
