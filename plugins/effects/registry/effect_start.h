#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "plugins/effects/registry/free_parameter.h"
#include "plugins/plant/model/plant_model.h"

namespace pedicel::effects {

/// Rough sizes of an experiment, from which fits of effects take their first values.
struct Scales {
  double length = 0.0;          ///< m, of the longest curve
  double mass = 0.0;            ///< kg, of the plant
  double root_stiffness = 0.0;  ///< N m/rad, EI/length at the root
  double curvature = 0.0;       ///< 1/m, the largest that the measured motion needs
  double duration = 0.0;        ///< s, of the longest trial
  double sample_time = 0.0;     ///< s, between samples
};

/// What an experiment is, as far as first values of effects depend on it.
struct StartContext {
  const plant::PlantFile& plant;
  Scales scales;
  double clock_span = 0.0;           ///< s, from the first trial's beginning to the last one's end
  std::vector<std::string> markers;  ///< names
  /// The trials in which the plant was held.
  struct Hold {
    std::string trial;
    double end = 0.0;        ///< s, when the first hold of the trial lets go
    double stiffness = 0.0;  ///< N/m, the largest that is stated; 0: none is
  };
  std::vector<Hold> holds;
  bool force = false;  ///< some trial has a force
};

/// One effect with values to begin a fit from, made value by value. Those that are free say between
/// which bounds; units and vanishing values are the definition's.
class Start {
 public:
  explicit Start(std::string name);

  Start& place(const std::string& curve, double at) {
    effect_.place = plant::CurvePlace{curve, at, {}};
    return *this;
  }
  Start& moving_place(const std::string& curve, double at) {
    place(curve, at);
    return parameter("at", 0, false, 0.1, 0.0, 1.0);
  }
  Start& fixed(const std::string& name, std::vector<double> value) {
    effect_.numbers[name] = std::move(value);
    return *this;
  }
  Start& word(const std::string& name, const std::string& value) {
    effect_.words[name] = value;
    return *this;
  }
  /// A positive quantity on a logarithmic scale.
  Start& positive(const std::string& name, double value, double low, double high) {
    fixed(name, {std::clamp(value, low, high)});
    return parameter(name, 0, true, 1.0, low, high);
  }
  Start& signed_number(const std::string& name, double value, double scale, double low,
                       double high) {
    fixed(name, {value});
    return parameter(name, 0, false, scale, low, high);
  }
  Start& vector(const std::string& name, const Vec3& value, double scale, double most,
                int components = 3) {
    fixed(name, {value.x(), value.y(), value.z()});
    for (int i = 0; i < components; ++i) parameter(name, i, false, scale, -most, most);
    return *this;
  }
  /// Two signed numbers.
  Start& pair(const std::string& name, double first, double second, double scale, double most) {
    fixed(name, {first, second});
    for (int i = 0; i < 2; ++i) parameter(name, i, false, scale, -most, most);
    return *this;
  }
  Start& free_share(double low, double high) {
    return parameter("share", 0, false, 1.0, low, high);
  }
  /// A horizontal unit vector, of which the angle (rad) is free.
  Start& heading(const std::string& name, double angle) {
    fixed(name, {std::cos(angle), std::sin(angle), 0.0});
    parameter("heading", 0, false, 0.3, -10.0, 10.0);
    free_.back().unit = "rad";
    free_.back().heading_of = name;
    return *this;
  }
  Start& prior(double deviation, double centre) {
    free_.back().prior = deviation;
    free_.back().prior_centre = centre;
    return *this;
  }
  /// With this value of the last parameter the effect does nothing.
  Start& vanishing_at(double value) {
    free_.back().vanishes = Vanishes::at_nominal;
    free_.back().nominal = value;
    return *this;
  }

  const plant::Effect& effect() const { return effect_; }
  const std::vector<FreeParameter>& free() const { return free_; }

 private:
  Start& parameter(const std::string& name, int component, bool logarithmic, double scale,
                   double low, double high);

  plant::Effect effect_;
  std::vector<FreeParameter> free_;
};

}  // namespace pedicel::effects
