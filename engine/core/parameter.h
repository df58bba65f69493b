#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pedicel {

/// Every number that a user can tune is described once: reading files, `--set`, `*.meta.json`, the
/// tuning panel, the bounds of a fit and the parameter page all come from this description.
struct Parameter {
  std::string name;  ///< snake_case, as in files
  std::string unit;  ///< one of known_units()
  std::variant<double*, int*, bool*> value;
  double minimum = 0.0;  ///< lowest value allowed
  double maximum = 0.0;  ///< highest value allowed
  std::string sentence;  ///< what it does and how to choose it

  double get() const;
};

/// The fixed list of units ("1" is dimensionless).
std::span<const std::string_view> known_units();

/// Sets a described parameter. Returns the sentence to show where the value is refused
/// ("rods.newton_iterations = -1: must be between 1 and 100"), nothing where it is taken.
std::optional<std::string> set_parameter(const Parameter& parameter, double value);

/// Finds a parameter by name; nullptr where there is none.
const Parameter* find_parameter(const std::vector<Parameter>& parameters, std::string_view name);

/// The names, comma separated, for "expected one of ..." sentences.
std::string parameter_names(const std::vector<Parameter>& parameters);

/// The first parameter whose value is outside its range, as a sentence; nothing where all are in.
std::optional<std::string> check_parameters(const std::vector<Parameter>& parameters);

}  // namespace pedicel
