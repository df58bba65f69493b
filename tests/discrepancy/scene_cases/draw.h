#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace pedicel::scene_case {

/// Numbers of made cases, from a seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random_);
  }
  /// Evenly in the logarithm.
  double size(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// Above or below 1, by a factor.
  double factor(double low, double high) {
    const double by = size(low, high);
    return chance(0.5) ? by : 1.0 / by;
  }
  std::vector<double> vector(double low, double high) {
    const double length = size(low, high), z = between(-1.0, 1.0),
                 turn = between(0.0, 2.0 * std::numbers::pi);
    const double across = length * std::sqrt(1.0 - z * z);
    return {across * std::cos(turn), across * std::sin(turn), length * z};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace pedicel::scene_case
