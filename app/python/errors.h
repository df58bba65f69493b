#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::python {

/// Thrown where a picture is asked for and there is no OpenGL off screen.
class NoPictures : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown where a simulation can go no further.
class Unstable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Turns the program's exceptions into those of pedicel/errors.py.
void add_errors();

/// Diagnostics as errors.py has them.
pybind11::list diagnostics_list(const std::vector<Diagnostic>& all);

}  // namespace pedicel::python
