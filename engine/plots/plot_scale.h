#pragma once

#include <string>
#include <vector>

namespace pedicel::plots {

/// A mark on an axis, at a round number.
struct Tick {
  double value = 0.0;
  std::string text;
};

/// One axis of a plot: which values it shows, and where.
class PlotScale {
 public:
  /// Values from low to high (widened where they coincide), between two pixel positions. A
  /// logarithmic scale needs low > 0.
  PlotScale(double low, double high, double from_px, double to_px, bool logarithmic);

  /// Moves both ends outwards to round numbers.
  void round_outwards();

  double low() const { return low_; }
  double high() const { return high_; }
  /// Pixel position of a value.
  double operator()(double value) const;
  bool shows(double value) const { return value >= low_ && value <= high_; }

  /// Marks at 1, 2 or 5 times a power of ten, about one every `spacing_px`; at powers of ten (and
  /// 2 and 5 times them over short ranges) on a logarithmic scale.
  std::vector<Tick> ticks(double spacing_px) const;
  /// Power of ten that the tick texts leave out, a multiple of 3; 0 where the numbers are handy.
  int exponent() const;

 private:
  double step(double spacing_px) const;
  std::vector<Tick> logarithmic_ticks() const;

  double low_, high_, from_, to_;
  bool logarithmic_;
};

}  // namespace pedicel::plots
