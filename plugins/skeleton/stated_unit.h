#pragma once

#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::plant {

/// A length in m. Divided where the unit is a part of a metre, so that whole millimetres come to
/// the same bits as in a file in metres.
double in_metres(double length, double unit);

/// The unit of a file's lengths: what the caller asks for, what the file or a column says, or the
/// usual one. Two that differ are an error.
class StatedLengthUnit {
 public:
  /// `asked` (m): by the caller; 0: nothing. `usual` (m): where nobody says one.
  StatedLengthUnit(double asked, std::string file, Diagnostics& diagnostics, double usual = 1.0)
      : asked_(asked),
        unit_(asked > 0.0 ? asked : usual),
        file_(std::move(file)),
        diagnostics_(diagnostics) {}

  /// What a line of the file says ("cm"); an empty text says nothing.
  void take(const std::string& text, int line);
  /// m, of the numbers in a column: its own `unit` where it says one, else the file's.
  double of_column(const std::string& name, const std::string& unit,
                   const SourcePosition& where) const;
  /// A length of the file in m.
  double metres(double length) const { return in_metres(length, unit_); }

 private:
  double asked_, unit_;  ///< m
  std::string file_;
  Diagnostics& diagnostics_;
};

}  // namespace pedicel::plant
