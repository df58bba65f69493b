#pragma once

#include <cmath>
#include <complex>
#include <optional>
#include <vector>

namespace pedicel {

/// A freely decaying oscillation, exp(-zeta w t) cos(w sqrt(1 - zeta^2) t).
struct RingDown {
  double frequency = 0.0;      ///< Hz, of the damped oscillation
  double damping_ratio = 0.0;  ///< 1, zeta; negative where it grows
};

/// The strongest oscillation about zero in evenly spaced samples, `dt` (s) apart. Nothing where the
/// samples cross zero fewer than 8 times.
///
/// Zero crossings give a first frequency f. Then both halves of the signal are seen through a Hann
/// window at f: the oscillation's complex amplitudes there differ by exactly exp((-zeta w + i (w -
/// 2 pi f)) T), T half the signal's length, which mends f and gives zeta. Higher modes and the
/// mirror frequency are k > 4 windows' bins away and fall off as 1/k^3.
inline std::optional<RingDown> ring_down(const std::vector<double>& samples, double dt) {
  constexpr double two_pi = 2.0 * 3.14159265358979323846;
  std::vector<double> crossings;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if ((samples[i - 1] < 0.0) != (samples[i] < 0.0))
      crossings.push_back(dt * (i - samples[i] / (samples[i] - samples[i - 1])));
  if (crossings.size() < 8) return std::nullopt;

  const std::size_t half = samples.size() / 2;
  double w = 0.5 * two_pi * (crossings.size() - 1) / (crossings.back() - crossings.front());
  const auto amplitude = [&](std::size_t first) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = first; i < first + half; ++i)
      sum +=
          samples[i] * (1.0 - std::cos(two_pi * (i - first) / half)) * std::polar(1.0, -w * dt * i);
    return sum;
  };
  std::complex<double> change;
  for (int pass = 0; pass < 3; ++pass) {
    change = amplitude(half) / amplitude(0);
    w += std::arg(change) / (half * dt);
  }
  const double decay = -std::log(std::abs(change)) / (half * dt);  // 1/s
  return RingDown{w / two_pi, decay / std::hypot(w, decay)};
}

}  // namespace pedicel
