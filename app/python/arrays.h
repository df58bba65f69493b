#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

#include "app/steer/state_arrays.h"
#include "engine/core/frames.h"

namespace pedicel::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A quantity as a view that cannot be written; it keeps `owner` alive. The first
/// axis is that of the worlds.
pybind11::array worlds_view(app::StateArrays& state, std::size_t quantity,
                            const pybind11::handle& owner);
/// The same of one world, without that axis.
pybind11::array world_view(app::StateArrays& state, std::size_t quantity, int world,
                           const pybind11::handle& owner);

/// "(segments, 3), m: where ...": shape, unit and sentence of a quantity, for its docstring.
std::string words_of(const app::Quantity& quantity, bool worlds);

/// Exactly `count` numbers. Throws UsageError, which names `what`.
std::vector<double> numbers_of(const Numbers& numbers, std::size_t count, const char* what);
Vec3 vec3_of(const Numbers& numbers, const char* what);
/// Of a sequence x y z w; made a unit one.
Quat quat_of(const Numbers& numbers, const char* what);
pybind11::array_t<double> array_of(const Eigen::VectorXd& vector);

}  // namespace pedicel::python
