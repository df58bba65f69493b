#pragma once

#include <string>

namespace pedicel::effects {

/// The value at which an effect vanishes, for the parameters that are its size; `never` for the
/// others.
enum class Vanishes { never, at_zero, at_one, at_infinity, at_nominal };

/// A number of an effect that a fit may change. Fits work on a scaled unknown u: value = scale u,
/// or value = exp(u) for positive quantities whose size is not known (`logarithmic`).
struct FreeParameter {
  int effect = 0;     ///< index into the effects of a model
  std::string name;   ///< of the effect's parameter; "at": of its place; "heading": see below
  int component = 0;  ///< of a vector
  bool logarithmic = false;
  double scale = 1.0;            ///< of the value, where not logarithmic
  double low = 0.0, high = 0.0;  ///< of the value
  std::string unit = {};
  /// Standard deviation and centre (a value) of a prior on u, where data may leave it open; 0:
  /// none.
  double prior = 0.0, prior_centre = 0.0;
  Vanishes vanishes = Vanishes::never;
  double nominal = 0.0;  ///< the value with which it vanishes `at_nominal`, > 0
  /// "heading" is the angle (rad) of a horizontal unit vector; this is the vector's name.
  std::string heading_of = {};

  /// What is known of u beforehand, as a standard deviation: the prior's, else a factor of 4.5
  /// either way, or three times the scale of its steps.
  double width() const;
  double to_unknown(double value) const;
  double to_value(double unknown) const;
};

}  // namespace pedicel::effects
