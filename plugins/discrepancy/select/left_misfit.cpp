#include "plugins/discrepancy/select/left_misfit.h"

#include <cmath>

#include "plugins/discrepancy/select/findings.h"

namespace pedicel::discrepancy {

namespace {

std::optional<double> share(const MisfitSums& sums) {
  const std::optional<double> whole = above_noise(sums.refitted, sums.samples);
  return whole ? std::optional((sums.told - sums.samples) / *whole) : std::nullopt;
}

std::optional<double> times_noise(const MisfitSums& sums) {
  return sums.samples > 0.0 ? std::optional(std::sqrt(sums.plain / sums.samples)) : std::nullopt;
}

}  // namespace

std::optional<double> above_noise(double square, double samples) {
  const double above = square - samples;
  // The sum of as many squares of noise scatters by itself.
  return above > interval95 * std::sqrt(2.0 * samples) ? std::optional(above) : std::nullopt;
}

MisfitSums& MisfitSums::operator+=(const MisfitSums& other) {
  refitted += other.refitted;
  told += other.told;
  plain += other.plain;
  samples += other.samples;
  return *this;
}

LeftMisfit left_misfit(const InstrumentSums& fit, const InstrumentSums& check) {
  MisfitSums fitted, held_out;
  InstrumentSums both = fit;
  for (const auto& [name, sums] : fit) fitted += sums;
  for (const auto& [name, sums] : check) {
    held_out += sums;
    both[name] += sums;
  }
  LeftMisfit left{{share(fitted), share(held_out)}, {times_noise(fitted), times_noise(held_out)}};
  for (const auto& [name, sums] : both)
    if (sums.samples > 0.0) left.channels.push_back({name, times_noise(sums), share(sums)});
  return left;
}

}  // namespace pedicel::discrepancy
