#include "app/dataset/split.h"

#include "app/sense/noise.h"

namespace pedicel::app {

std::string_view split_of(long picture, std::uint64_t seed) {
  constexpr int block = 10;
  Random random(noise_seed(seed, "split", static_cast<std::uint64_t>(picture / block)));
  const int validates = random.integer(0, block - 1);
  int tests = random.integer(0, block - 2);
  tests += tests >= validates;
  const int place = static_cast<int>(picture % block);
  if (place == validates) return "val";
  return place == tests ? "test" : "train";
}

}  // namespace pedicel::app
