#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pedicel::io {

/// What is measured.
enum class Quantity { none, time, length, angle, force, moment, mass, pixel };

/// A unit as people write it: what a number in it times `factor` is in SI units.
struct Unit {
  Quantity quantity = Quantity::none;
  double factor = 1.0;
};

/// s, ms, m, cm, mm, rad, deg, N, mN, gf, N m, ...: with or without brackets, in any case where
/// case tells nothing (mN is no MN). Nothing where it is unknown.
std::optional<Unit> unit_of(std::string_view text);

/// "m, cm or mm": what a column of that may be in.
std::string units_of(Quantity quantity);

/// What the lengths of a file are in, as people say it: m, cm, mm, in, or a number (0.01: how many
/// metres one is). In metres; nothing where it is none of these, or not positive.
std::optional<double> length_unit(std::string_view text);
/// "m, cm, mm or a number of metres": what length_unit() takes, for errors.
std::string expected_length_units();
/// "mm" for 0.001, else the number.
std::string length_unit_name(double unit);

/// A column's name and the unit behind it: "x (mm)", "x [mm]".
struct NamedUnit {
  std::string name;
  std::string unit;  ///< as written, without brackets; empty where there is none
};
NamedUnit split_unit(std::string_view heading);

/// "(mm)", "[mm]": what stands within; empty where the text is not in brackets as a whole.
std::string_view within_brackets(std::string_view text);

/// The unit of a name that ends in one (x_mm, time_s), where what is before it is `name`.
std::optional<Unit> unit_behind(std::string_view heading, std::string_view name);

/// Are the two the same but for capitals?
bool same_but_case(std::string_view a, std::string_view b);

}  // namespace pedicel::io
