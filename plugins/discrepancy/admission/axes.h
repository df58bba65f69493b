#pragma once

#include <string>
#include <vector>

#include "engine/core/frames.h"

namespace pedicel::discrepancy {

/// Another way to name the axes of a frame: each row has one entry, 1 or -1.
struct Axes {
  Mat3 read = Mat3::Identity();  ///< what is written, to what it should have been
  std::string what;              ///< "x and y exchanged?", the likely mistake
};

/// All 47 others, the commoner ones first.
const std::vector<Axes>& other_axes();

/// "(y, x, z)": what is read as x, y and z.
std::string as_read(const Mat3& read);

}  // namespace pedicel::discrepancy
