#include "engine/io/unit_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/io/csv.h"
#include "engine/io/number_text.h"

namespace pedicel::io {

namespace {

struct Known {
  std::string_view text;
  Unit unit;
};

constexpr double degree = 3.14159265358979323846 / 180.0;
constexpr double gravity = 9.80665;   ///< m/s2, of the units of force that are weights
constexpr double pound = 0.45359237;  ///< kg
constexpr double inch = 0.0254;       ///< m

constexpr auto t = Quantity::time, l = Quantity::length, an = Quantity::angle, f = Quantity::force,
               m = Quantity::moment, k = Quantity::mass;

// Capitals tell these apart.
constexpr std::array exact = {Known{"mN", {f, 1.0e-3}},   Known{"MN", {f, 1.0e6}},
                              Known{"mNm", {m, 1.0e-3}},  Known{"mN.m", {m, 1.0e-3}},
                              Known{"mN m", {m, 1.0e-3}}, Known{"mN*m", {m, 1.0e-3}},
                              Known{"Ms", {t, 1.0e6}},    Known{"Mg", {k, 1.0e3}}};

constexpr std::array any_case = {Known{"s", {t, 1.0}},
                                 Known{"sec", {t, 1.0}},
                                 Known{"secs", {t, 1.0}},
                                 Known{"second", {t, 1.0}},
                                 Known{"seconds", {t, 1.0}},
                                 Known{"ms", {t, 1.0e-3}},
                                 Known{"msec", {t, 1.0e-3}},
                                 Known{"millisecond", {t, 1.0e-3}},
                                 Known{"milliseconds", {t, 1.0e-3}},
                                 Known{"us", {t, 1.0e-6}},
                                 Known{"\xC2\xB5s", {t, 1.0e-6}},
                                 Known{"\xCE\xBCs", {t, 1.0e-6}},
                                 Known{"\xB5s", {t, 1.0e-6}},
                                 Known{"usec", {t, 1.0e-6}},
                                 Known{"microseconds", {t, 1.0e-6}},
                                 Known{"ns", {t, 1.0e-9}},
                                 Known{"nanoseconds", {t, 1.0e-9}},
                                 Known{"min", {t, 60.0}},
                                 Known{"minutes", {t, 60.0}},
                                 Known{"m", {l, 1.0}},
                                 Known{"metre", {l, 1.0}},
                                 Known{"metres", {l, 1.0}},
                                 Known{"meter", {l, 1.0}},
                                 Known{"meters", {l, 1.0}},
                                 Known{"dm", {l, 0.1}},
                                 Known{"cm", {l, 0.01}},
                                 Known{"centimetre", {l, 0.01}},
                                 Known{"centimetres", {l, 0.01}},
                                 Known{"centimeter", {l, 0.01}},
                                 Known{"centimeters", {l, 0.01}},
                                 Known{"mm", {l, 1.0e-3}},
                                 Known{"millimetre", {l, 1.0e-3}},
                                 Known{"millimetres", {l, 1.0e-3}},
                                 Known{"millimeter", {l, 1.0e-3}},
                                 Known{"millimeters", {l, 1.0e-3}},
                                 Known{"um", {l, 1.0e-6}},
                                 Known{"\xC2\xB5m", {l, 1.0e-6}},
                                 Known{"\xCE\xBCm", {l, 1.0e-6}},
                                 Known{"\xB5m", {l, 1.0e-6}},
                                 Known{"km", {l, 1.0e3}},
                                 Known{"in", {l, inch}},
                                 Known{"inch", {l, inch}},
                                 Known{"inches", {l, inch}},
                                 Known{"ft", {l, 12.0 * inch}},
                                 Known{"feet", {l, 12.0 * inch}},
                                 Known{"rad", {an, 1.0}},
                                 Known{"radian", {an, 1.0}},
                                 Known{"radians", {an, 1.0}},
                                 Known{"mrad", {an, 1.0e-3}},
                                 Known{"deg", {an, degree}},
                                 Known{"degree", {an, degree}},
                                 Known{"degrees", {an, degree}},
                                 Known{"\xC2\xB0", {an, degree}},
                                 Known{"\xB0", {an, degree}},
                                 Known{"n", {f, 1.0}},
                                 Known{"newton", {f, 1.0}},
                                 Known{"newtons", {f, 1.0}},
                                 Known{"kn", {f, 1.0e3}},
                                 Known{"gf", {f, 1.0e-3 * gravity}},
                                 Known{"kgf", {f, gravity}},
                                 Known{"lbf", {f, pound* gravity}},
                                 Known{"nm", {m, 1.0}},
                                 Known{"n m", {m, 1.0}},
                                 Known{"n.m", {m, 1.0}},
                                 Known{"n*m", {m, 1.0}},
                                 Known{"n\xC2\xB7m", {m, 1.0}},
                                 Known{"n-m", {m, 1.0}},
                                 Known{"nmm", {m, 1.0e-3}},
                                 Known{"n.mm", {m, 1.0e-3}},
                                 Known{"n mm", {m, 1.0e-3}},
                                 Known{"ncm", {m, 1.0e-2}},
                                 Known{"n cm", {m, 1.0e-2}},
                                 Known{"kg", {k, 1.0}},
                                 Known{"g", {k, 1.0e-3}},
                                 Known{"px", {Quantity::pixel, 1.0}},
                                 Known{"pixel", {Quantity::pixel, 1.0}},
                                 Known{"pixels", {Quantity::pixel, 1.0}},
                                 Known{"1", {Quantity::none, 1.0}}};

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
  for (const Known& known : exact)
    if (known.text == text) return known.unit;
  for (const Known& known : any_case)
    if (same_but_case(known.text, text)) return known.unit;
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
