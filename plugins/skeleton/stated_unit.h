#pragma once

#include <string>

#include "engine/core/diagnostics.h"

namespace pedicel::plant {

/// The unit of a file's lengths: what the caller asks for, what the file says, or m. Two that
/// differ are an error.
class StatedLengthUnit {
 public:
  /// `asked` (m): by the caller; 0: nothing.
  StatedLengthUnit(double asked, std::string file, Diagnostics& diagnostics)
      : asked_(asked),
        unit_(asked > 0.0 ? asked : 1.0),
        file_(std::move(file)),
        diagnostics_(diagnostics) {}

  /// What a line of the file says ("cm"); an empty text says nothing.
  void take(const std::string& text, int line);
  /// A length of the file in m. Divided where the unit is a part of a metre, so that whole
  /// millimetres come to the same bits as in a file in metres.
  double metres(double length) const;

 private:
  double asked_, unit_;  ///< m
  std::string file_;
  Diagnostics& diagnostics_;
};

}  // namespace pedicel::plant
