#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "app/python/errors.h"
#include "app/python/picture_thread.h"
#include "app/python/plant_class.h"
#include "app/python/run_class.h"
#include "app/report/version.h"
#include "app/session/document/document_parameters.h"
#include "engine/core/verbosity.h"
#include "engine/io/asset_folder.h"
#include "engine/io/csv.h"
#include "engine/robot/inverse_kinematics.h"
#include "engine/world/recorder.h"
#include "engine/world/variation.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

void add_values(py::module_& module) {
  using world::Event;
  py::class_<Event>(module, "Event", "A fruit that came off.")
      .def_readonly("time", &Event::time, "s")
      .def_readonly("organ", &Event::organ, "\"PLANT/FRUIT\"")
      .def_readonly("cause", &Event::cause, "stretch, bend, force, moment, torsion, law or cut")
      .def_readonly("stretch", &Event::stretch, "1, of the joint that broke")
      .def_readonly("bend", &Event::bend, "rad")
      .def_readonly("force", &Event::force, "N")
      .def_readonly("moment", &Event::moment, "N m")
      .def_readonly("torsion", &Event::torsion, "N m")
      .def_readonly("angle", &Event::angle, "rad, of the stalk to the vertical")
      .def("__repr__", [](const Event& e) {
        return "<Event " + std::to_string(e.time) + " s: " + e.organ + " comes off (" + e.cause +
               ")>";
      });
  using robot::IkResult;
  py::class_<IkResult>(module, "Reach", "What inverse kinematics found.")
      .def_property_readonly(
          "joints", [](const IkResult& r) { return array_of(r.q); }, "(joints,), rad or m")
      .def_readonly("reached", &IkResult::reached, "whether the tool comes there")
      .def_readonly("position_error", &IkResult::position_error, "m")
      .def_readonly("rotation_error", &IkResult::rotation_error, "rad")
      .def_readonly("sentence", &IkResult::sentence, "why not; empty where it is reached")
      .def("__repr__", [](const IkResult& r) {
        return "<Reach: " + (r.reached ? std::string("reached") : r.sentence) + ">";
      });
  using app::SessionParameter;
  py::class_<SessionParameter>(module, "Parameter", "A described number.")
      .def_readonly("key", &SessionParameter::key, "as for set()")
      .def_readonly("value", &SessionParameter::value, "now")
      .def_readonly("initial", &SessionParameter::initial, "as the files say")
      .def_readonly("unit", &SessionParameter::unit, "1: it has none")
      .def_readonly("low", &SessionParameter::minimum, "least that is allowed")
      .def_readonly("high", &SessionParameter::maximum, "most that is allowed")
      .def_readonly("sentence", &SessionParameter::sentence, "what it does")
      .def_readonly("restarts", &SessionParameter::restarts, "set up once: set() refuses it")
      .def("__repr__", [](const SessionParameter& p) {
        return "<Parameter " + p.key + " = " + io::format_number(p.value, 6) +
               (p.unit == "1" ? "" : " " + p.unit) + ">";
      });
}

void add_variation(py::module_& module) {
  using world::Variation;
  py::class_<Variation>(
      module, "Variation",
      "Numbers of a scene that differ from run to run: a map from keys of `--set` "
      "to distributions (uniform: low, high; normal, lognormal: mean, deviation; "
      "choice: values). The manual's page on Python has an example.")
      .def_static("read", &Variation::read, "path"_a,
                  "A file with `format: pedicel-variation` and a map `vary`.")
      .def_static("parse", &Variation::parse, "text"_a, "name"_a = "vary",
                  "The map as YAML (or JSON); `name` stands for the file in errors.")
      .def(
          "draw",
          [](const Variation& self, long seed) {
            py::dict drawn;
            const auto all = self.draw(static_cast<std::uint64_t>(checked_seed(seed)));
            for (const auto& [key, value] : all) drawn[key.c_str()] = value;
            return drawn;
          },
          "seed"_a, "Settings for Simulation or reset(): the same for the same seed.")
      .def_property_readonly(
          "keys",
          [](const Variation& self) {
            std::vector<std::string> keys;
            for (const world::VariedNumber& one : self.numbers()) keys.push_back(one.key);
            return keys;
          },
          "What varies, in the order in which it is drawn.");
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Pedicel's engine; to be used through the package pedicel.";
  // Errors are exceptions here, so nothing else needs to be said on standard error.
  set_verbosity(Verbosity::nothing);
  module.attr("version") = app::version();
  module.attr("git_hash") = app::git_hash();
  module.def("asset_folder", [] { return io::asset_folder().string(); });
  module.def("end_pictures", [] {
    const py::gil_scoped_release release;
    PictureThread::get().end();
  });
  add_errors();
  add_values(module);
  add_variation(module);
  add_plant_class(module);
  add_camera_classes(module);
  add_run_class(module);
  add_simulation_class(module);
  add_worlds_class(module);
}

}  // namespace pedicel::python
