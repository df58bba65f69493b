#include "app/python/arrays.h"

#include <cmath>

#include "engine/core/check.h"

namespace pedicel::python {

namespace py = pybind11;

namespace {

py::array read_only(const app::Quantity& quantity, const std::vector<py::ssize_t>& shape,
                    const void* data, const py::handle& owner) {
  py::array array(quantity.flag ? py::dtype::of<bool>() : py::dtype::of<double>(), shape, {}, data,
                  owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

std::vector<py::ssize_t> shape_of(const app::StateArrays& state, const app::Quantity& quantity) {
  std::vector<py::ssize_t> shape;
  if (quantity.rows != app::Rows::one) shape.push_back(state.layout().rows(quantity.rows));
  if (quantity.columns > 1) shape.push_back(quantity.columns);
  return shape;
}

}  // namespace

py::array worlds_view(app::StateArrays& state, std::size_t quantity, const py::handle& owner) {
  const app::Quantity& one = simulation::quantities()[quantity];
  std::vector<py::ssize_t> shape = shape_of(state, one);
  shape.insert(shape.begin(), state.worlds());
  if (one.flag) return read_only(one, shape, state.flags(quantity), owner);
  return read_only(one, shape, state.numbers(quantity), owner);
}

py::array world_view(app::StateArrays& state, std::size_t quantity, int world,
                     const py::handle& owner) {
  const app::Quantity& one = simulation::quantities()[quantity];
  const std::ptrdiff_t first =
      static_cast<std::ptrdiff_t>(world) * state.layout().rows(one.rows) * one.columns;
  if (one.flag) return read_only(one, shape_of(state, one), state.flags(quantity) + first, owner);
  return read_only(one, shape_of(state, one), state.numbers(quantity) + first, owner);
}

std::string words_of(const app::Quantity& quantity, bool worlds) {
  std::string shape = worlds ? "worlds" : "";
  const auto add = [&](const std::string& axis) { shape += (shape.empty() ? "" : ", ") + axis; };
  if (quantity.rows != app::Rows::one) add(std::string(name_of(quantity.rows)));
  if (quantity.columns > 1) add(std::to_string(quantity.columns));
  if (shape.find(',') == std::string::npos) shape += ",";
  return "(" + shape + "), " + (quantity.flag ? "bool" : std::string(quantity.unit)) + ": " +
         std::string(quantity.sentence) + ".";
}

std::vector<double> numbers_of(const Numbers& numbers, std::size_t count, const char* what) {
  if (numbers.ndim() != 1 || static_cast<std::size_t>(numbers.size()) != count)
    throw UsageError(std::string(what) + ": has " + std::to_string(numbers.size()) +
                     " numbers in " + std::to_string(numbers.ndim()) + " axes, expected " +
                     std::to_string(count) + " in one");
  return {numbers.data(), numbers.data() + count};
}

namespace {

std::vector<double> finite_numbers(const Numbers& numbers, std::size_t count, const char* what) {
  std::vector<double> all = numbers_of(numbers, count, what);
  for (const double number : all)
    if (!std::isfinite(number))
      throw UsageError(std::string(what) + ": a number is not finite, expected finite ones");
  return all;
}

}  // namespace

Vec3 vec3_of(const Numbers& numbers, const char* what) {
  const std::vector<double> v = finite_numbers(numbers, 3, what);
  return {v[0], v[1], v[2]};
}

Quat quat_of(const Numbers& numbers, const char* what) {
  const std::vector<double> q = finite_numbers(numbers, 4, what);
  const Quat quat(q[3], q[0], q[1], q[2]);
  if (!(quat.norm() > 1.0e-6))
    throw UsageError(std::string(what) + ": has no length, expected a quaternion x y z w");
  return quat.normalized();
}

py::array_t<double> array_of(const Eigen::VectorXd& vector) {
  return py::array_t<double>(vector.size(), vector.data());
}

}  // namespace pedicel::python
