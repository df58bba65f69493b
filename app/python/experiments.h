#pragma once

#include <pybind11/pybind11.h>

namespace pedicel::python {

/// diagnose, fit, observe and validate as texts, which pedicel/experiments.py turns into objects.
void add_experiments(pybind11::module_& module);

}  // namespace pedicel::python
