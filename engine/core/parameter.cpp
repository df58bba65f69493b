#include "engine/core/parameter.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "engine/core/joined.h"

namespace pedicel {

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::optional<std::string> refusal(const Parameter& parameter, double value) {
  const std::string head = parameter.name + " = " + number(value) +
                           (parameter.unit == "1" ? "" : " " + parameter.unit) + ": must be ";
  if (!std::isfinite(value)) return head + "a finite number";
  if (std::holds_alternative<bool*>(parameter.value)) {
    if (value != 0.0 && value != 1.0) return head + "true or false";
    return std::nullopt;
  }
  if (std::holds_alternative<int*>(parameter.value) && value != std::floor(value))
    return head + "a whole number";
  if (value < parameter.minimum || value > parameter.maximum)
    return head + "between " + number(parameter.minimum) + " and " + number(parameter.maximum);
  return std::nullopt;
}

}  // namespace

double Parameter::get() const {
  return std::visit([](auto* pointer) { return static_cast<double>(*pointer); }, value);
}

std::span<const std::string_view> known_units() {
  static constexpr std::array<std::string_view, 21> units = {
      "1",     "m",   "s",   "kg",    "N",     "Pa",   "rad",  "1/s",     "1/m", "Hz",  "m/s",
      "rad/s", "N/m", "N m", "N s/m", "kg/m3", "m/s2", "m2/m", "N m/rad", "px",  "nats"};
  return units;
}

std::optional<std::string> set_parameter(const Parameter& parameter, double value) {
  if (auto text = refusal(parameter, value)) return text;
  if (auto* const* p = std::get_if<double*>(&parameter.value)) **p = value;
  if (auto* const* p = std::get_if<int*>(&parameter.value)) **p = static_cast<int>(value);
  if (auto* const* p = std::get_if<bool*>(&parameter.value)) **p = value != 0.0;
  return std::nullopt;
}

const Parameter* find_parameter(const std::vector<Parameter>& parameters, std::string_view name) {
  for (const Parameter& parameter : parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

std::string parameter_names(const std::vector<Parameter>& parameters) {
  return joined(parameters, &Parameter::name);
}

std::optional<std::string> check_parameters(const std::vector<Parameter>& parameters) {
  for (const Parameter& parameter : parameters)
    if (auto text = refusal(parameter, parameter.get())) return text;
  return std::nullopt;
}

}  // namespace pedicel
