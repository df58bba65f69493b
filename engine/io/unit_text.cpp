#include "engine/io/unit_text.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/io/csv.h"
#include "engine/io/number_text.h"

namespace pedicel::io {

namespace {

/// A unit and the ways in which people write it.
struct Known {
  Unit unit;
  std::vector<std::string_view> texts;
};

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr double gravity = 9.80665;   ///< m/s2, of the units of force that are weights
constexpr double pound = 0.45359237;  ///< kg
constexpr double inch = 0.0254;       ///< m

constexpr auto t = Quantity::time, l = Quantity::length, an = Quantity::angle, f = Quantity::force,
               m = Quantity::moment, k = Quantity::mass;

const std::vector<Known>& told_by_capitals() {
  static const std::vector<Known> units = {
      {{f, 1.0e-3}, {"mN"}}, {{f, 1.0e6}, {"MN"}}, {{m, 1.0e-3}, {"mNm", "mN.m", "mN m", "mN*m"}},
      {{t, 1.0e6}, {"Ms"}},  {{k, 1.0e3}, {"Mg"}},
  };
  return units;
}

const std::vector<Known>& in_any_case() {
  static const std::vector<Known> units = {
      {{t, 1.0}, {"s", "sec", "secs", "second", "seconds"}},
      {{t, 1.0e-3}, {"ms", "msec", "millisecond", "milliseconds"}},
      {{t, 1.0e-6}, {"us", "\xC2\xB5s", "\xCE\xBCs", "\xB5s", "usec", "microseconds"}},
      {{t, 1.0e-9}, {"ns", "nanoseconds"}},
      {{t, 60.0}, {"min", "minutes"}},
      {{l, 1.0}, {"m", "metre", "metres", "meter", "meters"}},
      {{l, 0.1}, {"dm"}},
      {{l, 0.01}, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"}},
      {{l, 1.0e-3}, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}},
      {{l, 1.0e-6}, {"um", "\xC2\xB5m", "\xCE\xBCm", "\xB5m"}},
      {{l, 1.0e3}, {"km"}},
      {{l, inch}, {"in", "inch", "inches"}},
      {{l, 12.0 * inch}, {"ft", "feet"}},
      {{an, 1.0}, {"rad", "radian", "radians"}},
      {{an, 1.0e-3}, {"mrad"}},
      {{an, degree}, {"deg", "degree", "degrees", "\xC2\xB0", "\xB0"}},
      {{f, 1.0}, {"n", "newton", "newtons"}},
      {{f, 1.0e3}, {"kn"}},
      {{f, 1.0e-3 * gravity}, {"gf"}},
      {{f, gravity}, {"kgf"}},
      {{f, pound * gravity}, {"lbf"}},
      {{m, 1.0}, {"nm", "n m", "n.m", "n*m", "n\xC2\xB7m", "n-m"}},
      {{m, 1.0e-3}, {"nmm", "n.mm", "n mm"}},
      {{m, 1.0e-2}, {"ncm", "n cm"}},
      {{k, 1.0}, {"kg"}},
      {{k, 1.0e-3}, {"g"}},
      {{Quantity::pixel, 1.0}, {"px", "pixel", "pixels"}},
      {{Quantity::none, 1.0}, {"1"}},
  };
  return units;
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// "x / mm" (as ISO 80000 has it), "x in mm", "x, mm": only where a unit that is known comes behind.
NamedUnit unit_after_mark(std::string_view heading) {
  for (const std::string_view mark : {"/", " in ", ","}) {
    const std::size_t at = heading.rfind(mark);
    if (at == std::string_view::npos) continue;
    const std::string_view name = trimmed(heading.substr(0, at));
    const std::string_view unit = trimmed(heading.substr(at + mark.size()));
    if (!name.empty() && !unit.empty() && unit_of(unit))
      return {std::string(name), std::string(unit)};
  }
  return {std::string(heading), {}};
}

}  // namespace

bool same_but_case(std::string_view one, std::string_view other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view within_brackets(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2) return {};
  const bool round = text.front() == '(' && text.back() == ')';
  const bool square = text.front() == '[' && text.back() == ']';
  const bool curly = text.front() == '{' && text.back() == '}';
  return round || square || curly ? trimmed(text.substr(1, text.size() - 2)) : std::string_view{};
}

std::optional<Unit> unit_of(std::string_view text) {
  text = trimmed(text);
  if (const std::string_view within = within_brackets(text); !within.empty()) text = within;
  for (const Known& known : told_by_capitals())
    if (std::ranges::find(known.texts, text) != known.texts.end()) return known.unit;
  for (const Known& known : in_any_case())
    for (const std::string_view one : known.texts)
      if (same_but_case(one, text)) return known.unit;
  return std::nullopt;
}

std::optional<double> length_unit(std::string_view text) {
  const NumberText number = number_of(trimmed(text));
  if (number.kind == NumberText::Kind::number && number.value > 0.0) return number.value;
  const std::optional<Unit> unit = unit_of(text);
  if (!unit || unit->quantity != Quantity::length) return std::nullopt;
  return unit->factor;
}

std::string expected_length_units() {
  return "m, cm, mm or a number of metres";
}

std::string length_unit_name(double unit) {
  if (unit == 1.0) return "m";
  if (unit == 0.01) return "cm";
  if (unit == 0.001) return "mm";
  return format_number(unit) + " m";
}

std::string units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return "s, ms or us";
    case Quantity::length:
      return "m, cm or mm";
    case Quantity::angle:
      return "rad or deg";
    case Quantity::force:
      return "N, mN or gf";
    case Quantity::moment:
      return "N m or N mm";
    case Quantity::mass:
      return "kg or g";
    case Quantity::pixel:
      return "px";
    case Quantity::none:
      break;
  }
  return "no unit";
}

NamedUnit split_unit(std::string_view heading) {
  heading = trimmed(heading);
  for (const auto& [open, close] : {std::pair{'(', ')'}, std::pair{'[', ']'}}) {
    if (heading.empty() || heading.back() != close) continue;
    const std::size_t at = heading.rfind(open);
    if (at == std::string_view::npos || at == 0) continue;
    const std::string_view unit = trimmed(heading.substr(at + 1, heading.size() - at - 2));
    return {std::string(trimmed(heading.substr(0, at))), std::string(unit)};
  }
  return unit_after_mark(heading);
}

std::optional<Unit> unit_behind(std::string_view heading, std::string_view name) {
  if (heading.size() < name.size() + 2 || heading[name.size()] != '_') return std::nullopt;
  if (!same_but_case(heading.substr(0, name.size()), name)) return std::nullopt;
  return unit_of(heading.substr(name.size() + 1));
}

}  // namespace pedicel::io
