#pragma once

#include <string>
#include <string_view>

namespace pedicel::io {

/// How a table writes its numbers.
struct NumberStyle {
  char decimal = '.';  ///< '.' or ','
};

/// What a cell says.
struct NumberText {
  enum class Kind {
    number,
    missing,   ///< nothing was measured: empty, NA, NaN, null, -, ...
    infinite,  ///< inf, or too large
    unclear,   ///< two numbers, depending on what its mark means
    other      ///< no number
  };
  Kind kind = Kind::other;
  double value = 0.0;
};

/// A number as people and their programs write it: +1.5 .5 5. 1e-3 1E-3 1D-3, a Unicode minus,
/// groups of three digits (1,234.5 1'234.5) where they can be nothing else. `text` has no blanks
/// around it.
NumberText number_of(std::string_view text, const NumberStyle& style = {});

/// What the comma in a cell can be.
enum class CommaUse { none, decimal, groups, either };
CommaUse comma_use(std::string_view text);

/// Has one point that can only be a decimal one (0.5, 1.25, not 1.234).
bool has_decimal_point(std::string_view text);

/// Why a cell is no finite number, after its text: "is not a finite number", and what to write
/// where that can be told.
std::string why_no_number(std::string_view text, const NumberStyle& style = {});

}  // namespace pedicel::io
