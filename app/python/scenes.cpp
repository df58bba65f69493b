#include "app/python/scenes.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>

#include "app/python/plant_class.h"
#include "engine/core/check.h"
#include "engine/io/csv.h"

namespace pedicel::python {

namespace py = pybind11;

namespace {

std::filesystem::path path_of(const py::object& scene) {
  try {
    return scene.cast<std::filesystem::path>();
  } catch (const py::cast_error&) {
    throw py::type_error("a scene is a " +
                         py::str(py::type::of(scene).attr("__name__")).cast<std::string>() +
                         ", expected a path or a Plant");
  }
}

app::Document opened(const py::object& scene) {
  if (py::isinstance<Plant>(scene)) {
    app::Document document = app::empty_document();
    app::DocumentPlant one;
    one.file = std::make_shared<const plant::PlantFile>(scene.cast<const Plant&>().file);
    one.entry.name = one.file->name;
    document.plants.push_back(std::move(one));
    app::stand_on_ground(document);
    return document;
  }
  const std::filesystem::path path = path_of(scene);
  const py::gil_scoped_release release;
  return app::open_document(path);
}

void put_plants(app::Document& document, const py::dict& plants) {
  for (const auto& [name, plant] : plants) {
    const int index = document.plant_index(name.cast<std::string>());
    if (index < 0) document.plant(name.cast<std::string>());  // says which there are
    document.plants[static_cast<std::size_t>(index)].file =
        std::make_shared<const plant::PlantFile>(plant.cast<const Plant&>().file);
  }
}

}  // namespace

std::string setting_text(const py::handle& value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value)) return py::str(value).cast<std::string>();
  if (py::isinstance<py::sequence>(value)) {
    std::string text;
    for (const py::handle one : value) text += (text.empty() ? "" : ",") + setting_text(one);
    return text;
  }
  double number = 0.0;
  try {
    number = value.cast<double>();
  } catch (const py::cast_error&) {
    throw UsageError("a setting is a " +
                     py::str(py::type::of(value).attr("__name__")).cast<std::string>() +
                     ", expected a number, a word, or several numbers");
  }
  // "nan" and "inf" are refused by their names.
  return std::isfinite(number) ? io::exact_number(number) : std::to_string(number);
}

app::SteeredScene::Settings settings_of(const py::dict& settings) {
  app::SteeredScene::Settings all;
  for (const auto& [key, value] : settings)
    all.emplace_back(key.cast<std::string>(), setting_text(value));
  return all;
}

std::shared_ptr<const app::SteeredScene> make_scene(const py::object& scene, const py::dict& plants,
                                                    const std::vector<std::string>& packages,
                                                    const py::dict& settings) {
  app::Document document = opened(scene);
  put_plants(document, plants);
  document.settings = settings_of(settings);
  const py::gil_scoped_release release;
  return std::make_shared<const app::SteeredScene>(std::move(document), packages);
}

}  // namespace pedicel::python
