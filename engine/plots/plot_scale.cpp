#include "engine/plots/plot_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/core/check.h"
#include "engine/io/csv.h"

namespace pedicel::plots {

namespace {

/// The smallest of 1, 2, 5 times a power of ten that is at least `least`.
double round_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

}  // namespace

PlotScale::PlotScale(double low, double high, double from_px, double to_px, bool logarithmic)
    : low_(low), high_(high), from_(from_px), to_(to_px), logarithmic_(logarithmic) {
  PEDICEL_ASSERT(std::isfinite(low) && std::isfinite(high) && low <= high);
  PEDICEL_ASSERT(!logarithmic || low > 0.0);
  if (logarithmic && high < 1.001 * low) {
    low_ /= 2.0;
    high_ *= 2.0;
  } else if (!logarithmic && high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const double room = low == 0.0 ? 1.0 : 0.5 * std::abs(low);
    low_ -= room;
    high_ += room;
  }
}

double PlotScale::operator()(double value) const {
  const double share = logarithmic_ ? std::log(value / low_) / std::log(high_ / low_)
                                    : (value - low_) / (high_ - low_);
  return from_ + share * (to_ - from_);
}

double PlotScale::step(double spacing_px) const {
  const double count = std::max(std::abs(to_ - from_) / spacing_px, 1.0);
  return round_step((high_ - low_) / count);
}

void PlotScale::round_outwards() {
  if (logarithmic_) {
    const double decades = std::log10(high_ / low_);
    if (decades < 1.0) return;
    low_ = std::pow(10.0, std::floor(std::log10(low_) + 1e-9));
    high_ = std::pow(10.0, std::ceil(std::log10(high_) - 1e-9));
    return;
  }
  const double s = step(50.0);
  low_ = std::floor(low_ / s + 1e-9) * s;
  high_ = std::ceil(high_ / s - 1e-9) * s;
}

int PlotScale::exponent() const {
  if (logarithmic_) return 0;
  const double largest = std::max(std::abs(low_), std::abs(high_));
  if (largest >= 1e-2 && largest < 1e5) return 0;
  return 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0));
}

std::vector<Tick> PlotScale::ticks(double spacing_px) const {
  if (logarithmic_) return logarithmic_ticks();
  const double s = step(spacing_px);
  const int power = exponent();
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(s) + 1e-9)) + power);
  std::vector<Tick> ticks;
  const auto first = static_cast<long>(std::ceil(low_ / s - 1e-9));
  const auto last = static_cast<long>(std::floor(high_ / s + 1e-9));
  for (long i = first; i <= last; ++i) {
    const double value = static_cast<double>(i) * s;
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", decimals, value / std::pow(10.0, power));
    ticks.push_back({value, text});
  }
  return ticks;
}

std::vector<Tick> PlotScale::logarithmic_ticks() const {
  const bool fine = std::log10(high_ / low_) < 2.5;
  const auto first = static_cast<int>(std::floor(std::log10(low_)));
  const auto last = static_cast<int>(std::ceil(std::log10(high_)));
  std::vector<Tick> ticks;
  for (int power = first; power <= last; ++power)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, power);
      if (factor > 1.0 && !fine) break;
      if (value >= low_ * (1.0 - 1e-9) && value <= high_ * (1.0 + 1e-9))
        ticks.push_back({value, io::format_number(value, 3)});
    }
  return ticks;
}

}  // namespace pedicel::plots
