#include "app/python/plant_class.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/arrays.h"
#include "app/session/document/document.h"
#include "app/session/document/plant_import.h"
#include "engine/core/check.h"
#include "engine/core/joined.h"
#include "plugins/plant/organ_edit.h"
#include "plugins/plant/plant_builder.h"
#include "plugins/plant/plant_edit.h"
#include "plugins/plant/plant_numbers.h"
#include "plugins/simulation/plants/plant_overrides.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

std::vector<Vec3> points_of(const Numbers& points) {
  if (points.ndim() != 2 || points.shape(1) != 3)
    throw UsageError("points: expected an array (points, 3), m");
  std::vector<Vec3> all;
  for (py::ssize_t i = 0; i < points.shape(0); ++i)
    all.emplace_back(points.at(i, 0), points.at(i, 1), points.at(i, 2));
  return all;
}

std::vector<double> radii_of(const py::object& radius) {
  if (py::isinstance<py::float_>(radius) || py::isinstance<py::int_>(radius))
    return {radius.cast<double>()};
  try {
    return radius.cast<std::vector<double>>();
  } catch (const py::cast_error&) {
    throw UsageError("radius is a " +
                     py::str(py::type::of(radius).attr("__name__")).cast<std::string>() +
                     ", expected a number, or one a point, m");
  }
}

plant::Interpolation interpolation_of(const std::string& word) {
  if (word == "smooth") return plant::Interpolation::smooth;
  if (word == "linear") return plant::Interpolation::linear;
  throw UsageError("interpolation = " + in_quotes(word) + ": expected smooth or linear");
}

Plant load_plant(const std::filesystem::path& path, const std::string& unit) {
  Diagnostics diagnostics;
  auto file = app::read_plant(path, diagnostics, app::unit_of_text(unit, "unit"));
  if (!file) throw InvalidFile(diagnostics);
  return {std::move(*file)};
}

Plant parse_plant(const std::string& text, const std::string& name) {
  Diagnostics diagnostics;
  auto file = plant::parse_plant(text, name, diagnostics);
  if (!file) throw InvalidFile(diagnostics);
  return {std::move(*file)};
}

Plant make_plant(const std::string& name, double youngs_modulus, double poisson_ratio,
                 double density, double damping_time, double distance, double connect,
                 const std::string& shape) {
  Plant plant;
  plant.file.name = name;
  plant.file.material.youngs_modulus = youngs_modulus;
  plant.file.material.poisson_ratio = poisson_ratio;
  plant.file.material.density = density;
  plant.file.material.damping_time = damping_time;
  plant.file.distance = distance;
  plant.file.connect = connect;
  if (shape != "drawn" && shape != "rest")
    throw UsageError("shape = " + in_quotes(shape) + ": expected drawn or rest");
  plant.file.shape = shape == "drawn" ? plant::Shape::drawn : plant::Shape::rest;
  return plant;
}

void add_stem(Plant& self, const std::string& name, const Numbers& points, const py::object& radius,
              const std::string& interpolation) {
  plant::PlantCurve curve;
  curve.name = name;
  curve.points = points_of(points);
  curve.radius = radii_of(radius);
  curve.interpolation = interpolation_of(interpolation);
  const bool first = self.file.curves.empty();
  const Vec3 foot = curve.points.empty() ? Vec3(Vec3::Zero()) : curve.points.front();
  plant::add_stem(self.file, std::move(curve));
  if (first) self.file.root = foot;
}

void add_fruit(Plant& self, const std::string& name, const std::string& stem, double at,
               double radius, double density, const std::map<std::string, double>& detach) {
  plant::PlantFruit fruit;
  fruit.name = name;
  fruit.place = {stem, at, {}};
  fruit.radius = radius;
  fruit.density = density;
  plant::PlantFile changed = self.file;
  plant::add_fruit(changed, std::move(fruit));
  for (const auto& [key, value] : detach) plant::set_organ(changed, name, key, value);
  self.file = std::move(changed);
}

void add_leaf(Plant& self, const std::string& name, const std::string& stem, double at,
              const std::string& leaf_template, double size, const Numbers& normal) {
  plant::PlantLeaf leaf;
  leaf.name = name;
  leaf.place = {stem, at, {}};
  leaf.leaf_template = leaf_template;
  leaf.size = size;
  leaf.normal = vec3_of(normal, "normal");
  plant::add_leaf(self.file, std::move(leaf));
}

py::dict check(const Plant& self) {
  Diagnostics diagnostics;
  plant::BuildOptions options;
  options.leaf_folders = app::asset_leaf_folders();
  std::optional<plant::BuiltPlant> built;
  if (plant::check_plant(self.file, diagnostics))
    built = plant::build_plant(self.file, options, diagnostics);
  if (!built) throw InvalidFile(diagnostics);
  py::dict found;
  found["segments"] = built->model.size();
  found["length"] = built->length_drawn;
  found["settles"] = plant::residual_text(*built);
  return found;
}

const plant::PlantNumber& number_of(const std::string& key) {
  if (const plant::PlantNumber* number = plant::find_plant_number(key)) return *number;
  throw UsageError("no number " + in_quotes(key) + " of a plant, expected one of: " +
                   joined(plant::plant_numbers(), &plant::PlantNumber::key));
}

std::vector<std::string> names_of(const auto& all) {
  std::vector<std::string> names;
  for (const auto& one : all) names.push_back(one.name);
  return names;
}

using PlantClass = py::class_<Plant>;

void add_drawing(PlantClass& plant) {
  plant
      .def(
          "add_stem", &add_stem, "name"_a, "points"_a, "radius"_a, "interpolation"_a = "smooth",
          "points (points, 3), m; radius in m: one number, or one a point. A stem that begins near "
          "another one is its branch; the first stem's first point becomes the root.")
      .def("add_fruit", &add_fruit, "name"_a, "stem"_a, "at"_a, "radius"_a,
           "density"_a = plant::usual_fruit_density, "detach"_a = std::map<std::string, double>{},
           "A sphere of radius (m) and density (kg/m3) at a fraction of the stem's length. detach: "
           "thresholds by name: stretch (1), bend (rad), force (N), moment, torsion (N m).")
      .def("add_leaf", &add_leaf, "name"_a, "stem"_a, "at"_a, "template"_a, "size"_a,
           "normal"_a = py::make_tuple(0.0, 0.0, 1.0),
           "A leaf of a template (NAME.leaf.yaml), size in m from its foot to its tip.")
      .def(
          "add_mass",
          [](Plant& p, const std::string& stem, double at, double mass) {
            plant::add_mass(p.file, stem, at, mass);
          },
          "stem"_a, "at"_a, "mass"_a, "A point mass, kg.")
      .def(
          "add_support",
          [](Plant& p, const std::string& stem, double at) {
            plant::add_support(p.file, stem, at);
          },
          "stem"_a, "at"_a, "Holds a place of a stem where it is.")
      .def(
          "remove",
          [](Plant& p, const std::string& name) {
            if (p.file.curve_index(name) >= 0) return plant::remove_stem(p.file, name);
            plant::remove_organ(p.file, name);
          },
          "name"_a, "Takes a stem with everything on it, a fruit or a leaf away.")
      .def(
          "rename",
          [](Plant& p, const std::string& name, const std::string& to) {
            plant::rename(p.file, name, to);
          },
          "name"_a, "to"_a, "Gives a stem, a fruit or a leaf another name.")
      .def(
          "place",
          [](Plant& p, const std::string& name, const std::string& stem, double at) {
            plant::place_organ(p.file, name, stem, at);
          },
          "name"_a, "stem"_a, "at"_a, "Moves a fruit or a leaf along its stem, or to another.")
      .def(
          "set_points",
          [](Plant& p, const std::string& stem, const Numbers& points) {
            plant::set_points(p.file, stem, points_of(points));
          },
          "stem"_a, "points"_a, "(points, 3), m. What is on the stem keeps its fraction.")
      .def(
          "points",
          [](const Plant& p, const std::string& stem) {
            const auto& points = p.file.curves[plant::find_stem(p.file, stem)].points;
            py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
            for (std::size_t i = 0; i < points.size(); ++i)
              for (int c = 0; c < 3; ++c)
                array.mutable_at(static_cast<py::ssize_t>(i), c) = points[i][c];
            return array;
          },
          "stem"_a, "(points, 3), m: control points of a stem.")
      .def(
          "set_length",
          [](Plant& p, const std::string& stem, double length) {
            plant::set_length(p.file, stem, length);
          },
          "stem"_a, "length"_a, "Scales a stem about its foot until it is that long, m.")
      .def(
          "set_radius",
          [](Plant& p, const std::string& stem, double radius) {
            plant::set_radius(p.file, stem, -1, radius);
          },
          "stem"_a, "radius"_a, "m, everywhere.")
      .def(
          "taper",
          [](Plant& p, const std::string& stem, double from, double to) {
            plant::taper(p.file, stem, from, to);
          },
          "stem"_a, "from_radius"_a, "to_radius"_a, "Radii, m, from its foot to its tip.")
      .def(
          "trim",
          [](Plant& p, const std::string& stem, double at) { plant::trim_stem(p.file, stem, at); },
          "stem"_a, "at"_a, "Cuts a stem; what lies beyond goes.");
}

}  // namespace

void add_plant_class(py::module_& module) {
  PlantClass plant(
      module, "Plant",
      "A plant that is built, edited and saved: what a plant file says. Edits that are "
      "impossible raise UsageError and change nothing. Lengths in m.");
  plant
      .def(py::init(&make_plant), "name"_a, py::kw_only(), "youngs_modulus"_a = 2.0e7,
           "poisson_ratio"_a = 0.35, "density"_a = 700.0, "damping_time"_a = 0.01,
           "distance"_a = 0.02, "connect"_a = 0.01, "shape"_a = "drawn",
           "An empty plant: material in Pa, 1, kg/m3 and s; sampling in m; shape drawn or rest.")
      .def_static("load", &load_plant, "path"_a, "unit"_a = "",
                  "Reads a plant file or a skeleton (table, MTG, PLY, XML of Helios). unit: of its "
                  "lengths.")
      .def_static("parse", &parse_plant, "text"_a, "name"_a = "plant.yaml",
                  "Reads a plant file from text; `name` stands for the file in errors.")
      .def(
          "save",
          [](const Plant& p, const std::filesystem::path& path) {
            plant::write_plant_file(path, p.file);
          },
          "path"_a, "Writes a plant file, in one piece.")
      .def(
          "text", [](const Plant& p) { return plant::plant_text(p.file); },
          "The plant file's text; parse(text()) is equal to it.")
      .def(
          "copy", [](const Plant& p) { return p; }, "Another plant with the same in it.")
      .def("__copy__", [](const Plant& p) { return p; })
      .def(
          "__deepcopy__", [](const Plant& p, const py::dict&) { return p; }, "memo"_a)
      .def(py::pickle([](const Plant& p) { return plant::plant_text(p.file); },
                      [](const std::string& text) { return parse_plant(text, "a pickled plant"); }))
      .def("check", &check,
           "Builds it: segments, length (m) and how far it settles from its drawing. Raises "
           "InvalidFile with every fault.")
      .def(
          "get",
          [](const Plant& p, const std::string& key) {
            return plant::value_of(p.file, number_of(key));
          },
          "key"_a, "A described number (material.density); None where the plant says nothing.")
      .def(
          "set",
          [](Plant& p, const std::string& key, double value) {
            const plant::PlantNumber& number = number_of(key);
            if (!io::within(value, number.bounds))
              throw UsageError(key + " = " + std::to_string(value) + ": must be " +
                               io::bounds_text(number.bounds));
            plant::set_number(p.file, number, value);
          },
          "key"_a, "value"_a, "Sets one; curves with a number of their own keep their ratio.")
      .def(
          "set_organ",
          [](Plant& p, const std::string& name, const std::string& key, double value) {
            plant::set_organ(p.file, name, key, value);
          },
          "name"_a, "key"_a, "value"_a,
          "A number of a fruit (radius, density, stretch, bend, force, moment, torsion) or of a "
          "leaf (size).")
      .def_property(
          "name", [](const Plant& p) { return p.file.name; },
          [](Plant& p, const std::string& name) { p.file.name = name; }, "Its name.")
      .def_property_readonly(
          "stems", [](const Plant& p) { return names_of(p.file.curves); }, "Names of the stems.")
      .def_property_readonly(
          "fruits", [](const Plant& p) { return names_of(p.file.fruits); }, "Names of the fruits.")
      .def_property_readonly(
          "leaves", [](const Plant& p) { return names_of(p.file.leaves); }, "Names of the leaves.")
      .def("__eq__", [](const Plant& a, const Plant& b) { return a.file == b.file; })
      .def("__repr__", [](const Plant& p) {
        return "<Plant " + p.file.name + ": " + std::to_string(p.file.curves.size()) + " stems, " +
               std::to_string(p.file.fruits.size()) + " fruits, " +
               std::to_string(p.file.leaves.size()) + " leaves>";
      });
  add_drawing(plant);
}

}  // namespace pedicel::python
