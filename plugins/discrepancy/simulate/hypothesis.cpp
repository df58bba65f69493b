#include "plugins/discrepancy/simulate/hypothesis.h"

#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/simulate/force_term.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

Hypothesis::Hypothesis(const effects::Start& start)
    : name(start.effect().name), effects{start.effect()}, free(start.free()) {}

double Hypothesis::value(int parameter) const {
  const FreeParameter& p = free[parameter];
  const plant::Effect& effect = effects[p.effect];
  if (p.name == "at") return effect.place->at;
  if (p.name == "heading") {
    const std::vector<double>& direction = effect.numbers.at(p.heading_of);
    return std::atan2(direction[1], direction[0]);
  }
  return effect.numbers.at(p.name)[p.component];
}

void Hypothesis::set_value(int parameter, double value) {
  const FreeParameter& p = free[parameter];
  plant::Effect& effect = effects[p.effect];
  if (p.name == "at")
    effect.place->at = value;
  else if (p.name == "heading")
    effect.numbers[p.heading_of] = {std::cos(value), std::sin(value), 0.0};
  else
    effect.numbers[p.name][p.component] = value;
}

Eigen::VectorXd Hypothesis::unknowns() const {
  Eigen::VectorXd u(size());
  for (int i = 0; i < size(); ++i) u[i] = free[i].to_unknown(value(i));
  return u;
}

void Hypothesis::set_unknowns(const Eigen::VectorXd& unknowns) {
  for (int i = 0; i < size(); ++i)
    set_value(i, std::clamp(free[i].to_value(unknowns[i]), free[i].low, free[i].high));
}

Eigen::VectorXd Hypothesis::low() const {
  Eigen::VectorXd u(size());
  for (int i = 0; i < size(); ++i) u[i] = free[i].to_unknown(free[i].low);
  return u;
}

Eigen::VectorXd Hypothesis::high() const {
  Eigen::VectorXd u(size());
  for (int i = 0; i < size(); ++i) u[i] = free[i].to_unknown(free[i].high);
  return u;
}

int Hypothesis::factor_on(const std::string& parameter) const {
  for (int p = 0; p < size(); ++p)
    if (free[p].name == "factor" && effects[free[p].effect].name == parameter) return p;
  return -1;
}

int Hypothesis::factor_on(plant::MaterialRole role) const {
  return factor_on(effects::material_factor(role).name);
}

Variant Hypothesis::variant() const {
  Variant variant;
  for (const plant::Effect& effect : effects) {
    if (effect.name == missing_force)
      variant.forces.push_back(point_force(effect));
    else if (effect.name != mesh_error)
      variant.effects.push_back(effect);
  }
  return variant;
}

double Hypothesis::mesh_share() const {
  for (const plant::Effect& effect : effects)
    if (effect.name == mesh_error) return effect.number("share");
  return 0.0;
}

void Hypothesis::add(const Hypothesis& other) {
  const int shift = static_cast<int>(effects.size());
  effects.insert(effects.end(), other.effects.begin(), other.effects.end());
  for (FreeParameter parameter : other.free) {
    parameter.effect += shift;
    free.push_back(parameter);
  }
}

Hypothesis Hypothesis::without(int effect) const {
  Hypothesis other = *this;
  other.effects.erase(other.effects.begin() + effect);
  std::erase_if(other.free, [&](const FreeParameter& one) { return one.effect == effect; });
  for (FreeParameter& one : other.free) one.effect -= one.effect > effect ? 1 : 0;
  return other;
}

Hypothesis Hypothesis::shrunk(double share) const {
  Hypothesis result = *this;
  for (int i = 0; i < size(); ++i) {
    const double v = value(i);
    switch (free[i].vanishes) {
      case Vanishes::never:
        break;
      case Vanishes::at_zero:
        result.set_value(i, share * v);
        break;
      case Vanishes::at_one:
        result.set_value(i, 1.0 + share * (v - 1.0));
        break;
      case Vanishes::at_nominal:
        result.set_value(i, free[i].nominal * std::pow(v / free[i].nominal, share));
        break;
      case Vanishes::at_infinity:
        result.set_value(i, v / share);
        break;
    }
  }
  return result;
}

Hypothesis Hypothesis::bounded() const {
  Hypothesis result = *this;
  for (int i = 0; i < size(); ++i)
    result.set_value(i, std::clamp(value(i), free[i].low, free[i].high));
  return result;
}

}  // namespace pedicel::discrepancy
