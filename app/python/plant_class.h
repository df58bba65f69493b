#pragma once

#include <pybind11/pybind11.h>

#include "plugins/plant/plant_file.h"

namespace pedicel::python {

/// A plant that is built and edited in Python.
struct Plant {
  plant::PlantFile file;
};

void add_plant_class(pybind11::module_& module);

}  // namespace pedicel::python
