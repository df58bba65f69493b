#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "discrepancy/cause_names.h"

namespace pedicel::discrepancy {

/// A hypothesis of one effect under construction, value by value. Those that are free say between
/// which bounds.
class Start {
 public:
  Start(const std::string& name) {
    made_.name = name;
    made_.effects.push_back(plant::Effect{name, {}, {}, {}, {}});
  }
  Start& place(const std::string& curve, double at) {
    made_.effects[0].place = plant::CurvePlace{curve, at, {}};
    return *this;
  }
  Start& moving_place(const std::string& curve, double at) {
    place(curve, at);
    return parameter("at", 0, false, 0.1, 0.0, 1.0);
  }
  Start& fixed(const std::string& name, std::vector<double> value) {
    made_.effects[0].numbers[name] = std::move(value);
    return *this;
  }
  Start& word(const std::string& name, const std::string& value) {
    made_.effects[0].words[name] = value;
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
  Start& free_share(double low, double high) {
    return parameter("share", 0, false, 1.0, low, high);
  }
  Start& heading(double angle) {
    fixed("direction", {std::cos(angle), std::sin(angle), 0.0});
    return parameter("heading", 0, false, 0.3, -10.0, 10.0);
  }
  Start& prior(double deviation, double centre) {
    made_.free.back().prior = deviation;
    made_.free.back().prior_centre = centre;
    return *this;
  }
  /// With this value of the last parameter the effect does nothing.
  Start& vanishing_at(double value) {
    made_.free.back().vanishes = Vanishes::at_nominal;
    made_.free.back().nominal = value;
    return *this;
  }
  operator Hypothesis() const { return made_; }

 private:
  Start& parameter(const std::string& name, int component, bool logarithmic, double scale,
                   double low, double high) {
    FreeParameter free{0, name, component, logarithmic, scale, low, high, {}};
    free.unit = unit_of(made_.name, name);
    free.vanishes = vanishing(made_.name, name);
    made_.free.push_back(free);
    return *this;
  }
  Hypothesis made_;
};

}  // namespace pedicel::discrepancy
