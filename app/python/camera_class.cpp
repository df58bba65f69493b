#include <pybind11/stl.h>

#include "app/python/run_class.h"
#include "app/sense/point_cloud.h"
#include "engine/core/check.h"
#include "plugins/simulation/instrument.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

using app::Keypoint;
using app::SensedPicture;

/// What a thing is called in pictures.
struct Thing {
  int id;
  std::string name, kind, plant;
};

/// A picture with what its labels mean.
struct CameraPicture {
  SensedPicture seen;
  std::vector<Thing> things;
  std::vector<std::uint8_t> class_of;  ///< by label
};

struct NamedKeypoint {
  Keypoint point;
  std::string organ;
};

std::vector<Thing> things_of(const std::vector<app::NamedThing>& things) {
  std::vector<Thing> all;
  for (const app::NamedThing& one : things)
    all.push_back(
        {static_cast<int>(all.size()), one.name, std::string(name_of(one.kind)), one.plant});
  return all;
}

/// An array that takes the numbers over; it keeps `owner` alive.
template <class Number>
py::array_t<Number> grid(const CameraPicture& self, const Number* data, const py::object& owner) {
  const auto width = static_cast<py::ssize_t>(self.seen.map.width);
  const auto height = static_cast<py::ssize_t>(self.seen.map.height);
  return py::array_t<Number>({height, width}, data, owner);
}

py::object colours_of(const py::object& owner) {
  const auto& self = owner.cast<const CameraPicture&>();
  if (self.seen.image.rgb.empty()) return py::none();
  return py::array_t<std::uint8_t>(
      {static_cast<py::ssize_t>(self.seen.image.height),
       static_cast<py::ssize_t>(self.seen.image.width), static_cast<py::ssize_t>(3)},
      self.seen.image.rgb.data(), owner);
}

py::array_t<std::uint8_t> classes_of(const CameraPicture& self) {
  py::array_t<std::uint8_t> array({static_cast<py::ssize_t>(self.seen.map.height),
                                   static_cast<py::ssize_t>(self.seen.map.width)});
  std::uint8_t* to = array.mutable_data();
  for (const render::Label label : self.seen.map.labels) *to++ = self.class_of[label];
  return array;
}

std::vector<NamedKeypoint> keypoints_of(const CameraPicture& self) {
  std::vector<NamedKeypoint> all;
  for (const Keypoint& one : self.seen.keypoints) all.push_back({one, self.things[one.thing].name});
  return all;
}

py::tuple points_of(const CameraPicture& self) {
  const app::PointCloud cloud = app::point_cloud_of(self.seen);
  const auto n = static_cast<py::ssize_t>(cloud.size());
  const auto three = static_cast<py::ssize_t>(3);
  py::object colours = py::none();
  if (!cloud.colours.empty()) colours = py::array_t<std::uint8_t>({n, three}, cloud.colours.data());
  return py::make_tuple(py::array_t<float>({n, three}, cloud.positions.data()),
                        py::array_t<std::uint32_t>(n, cloud.labels.data()), colours);
}

template <class Matrix>
py::array_t<double> matrix_of(const Matrix& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  return py::array_t<double>(
      {static_cast<py::ssize_t>(rows.rows()), static_cast<py::ssize_t>(rows.cols())}, rows.data());
}

CameraPicture take(Run& self, const std::string& camera, const std::optional<int>& width,
                   const std::optional<int>& height, bool rgb, bool noise, bool fast) {
  app::SenseRequest wanted{camera, {}, rgb, noise, fast};
  if (width.has_value() != height.has_value())
    throw UsageError("camera(): expected width and height, or none of them");
  if (width) wanted.size = {*width, *height};
  CameraPicture picture;
  picture.seen = self.sense(wanted);
  const std::vector<app::NamedThing> things = self.things();
  picture.things = things_of(things);
  for (const app::NamedThing& one : things)
    picture.class_of.push_back(static_cast<std::uint8_t>(one.kind));
  return picture;
}

void add_picture(py::module_& module) {
  py::class_<CameraPicture>(module, "CameraPicture",
                            "What a camera of the scene sees. Its frame has x to the right, y down "
                            "and z forward; pixels count from the upper left corner, and the "
                            "middle of the first one is (0.5, 0.5).")
      .def_property_readonly(
          "time", [](const CameraPicture& p) { return p.seen.time; }, "s, of what is seen")
      .def_property_readonly("rgb", colours_of, "(height, width, 3) uint8, sRGB; None without")
      .def_property_readonly(
          "depth",
          [](const py::object& self) {
            const auto& p = self.cast<const CameraPicture&>();
            return grid(p, p.seen.map.depth.data(), self);
          },
          "(height, width) float32, m along the view axis: inf where nothing is, nan where noise "
          "has lost it")
      .def_property_readonly(
          "instances",
          [](const py::object& self) {
            const auto& p = self.cast<const CameraPicture&>();
            return grid(p, p.seen.map.labels.data(), self);
          },
          "(height, width) uint32: the id of the Thing at each pixel; 0: none")
      .def_property_readonly("classes", classes_of,
                             "(height, width) uint8: index into Run.thing_classes")
      .def_property_readonly("keypoints", keypoints_of,
                             "Keypoints of all organs, those outside of the picture, too")
      .def("points", points_of,
           "Point cloud: positions (n, 3) float32 (m, world), ids (n,), colours (n, 3) or None.")
      .def_property_readonly(
          "intrinsic", [](const CameraPicture& p) { return matrix_of(p.seen.camera.intrinsic); },
          "(3, 3), px: camera frame to picture")
      .def_property_readonly(
          "extrinsic", [](const CameraPicture& p) { return matrix_of(p.seen.camera.extrinsic); },
          "(4, 4): world to camera frame")
      .def_property_readonly(
          "pose",
          [](const CameraPicture& p) {
            Eigen::VectorXd pose(7);
            pose << p.seen.camera.pose.position, p.seen.camera.pose.rotation.coeffs();
            return array_of(pose);
          },
          "(7,): position (m) and quaternion x y z w of the camera frame in the world")
      .def_property_readonly(
          "things", [](const CameraPicture& p) { return p.things; }, "Things by their id");
}

}  // namespace

void add_camera_classes(py::module_& module) {
  py::class_<Thing>(module, "Thing", "Something that pictures tell from the rest.")
      .def_readonly("id", &Thing::id, "its number in instance masks, the same in all of a run")
      .def_readonly("name", &Thing::name, "\"PLANT/ORGAN\", \"ROBOT/LINK\", a body, \"ground\"")
      .def_readonly("kind", &Thing::kind, "one of Run.thing_classes")
      .def_readonly("plant", &Thing::plant, "that it belongs to; empty: none")
      .def("__repr__", [](const Thing& t) {
        return "<Thing " + std::to_string(t.id) + ": " + t.name + " (" + t.kind + ")>";
      });
  py::class_<NamedKeypoint>(module, "Keypoint", "A place on an organ, as a picture has it.")
      .def_readonly("organ", &NamedKeypoint::organ, "\"PLANT/ORGAN\"")
      .def_property_readonly(
          "id", [](const NamedKeypoint& k) { return k.point.thing; }, "of its Thing")
      .def_property_readonly(
          "name", [](const NamedKeypoint& k) { return std::string(name_of(k.point.kind)); },
          "centre and attachment of fruits; foot and tip of stems, branches and stalks")
      .def_property_readonly(
          "position",
          [](const NamedKeypoint& k) { return array_of(Eigen::VectorXd(k.point.position)); },
          "(3,), m, world")
      .def_property_readonly(
          "u", [](const NamedKeypoint& k) { return k.point.u; }, "px to the right")
      .def_property_readonly(
          "v", [](const NamedKeypoint& k) { return k.point.v; }, "px down")
      .def_property_readonly(
          "depth", [](const NamedKeypoint& k) { return k.point.depth; }, "m along the view axis")
      .def_property_readonly(
          "visibility", [](const NamedKeypoint& k) { return static_cast<int>(k.point.visibility); },
          "0: outside of the picture, 1: hidden, 2: seen")
      .def("__repr__", [](const NamedKeypoint& k) {
        return "<Keypoint " + k.organ + " " + std::string(name_of(k.point.kind)) + ">";
      });
  add_picture(module);
}

namespace {

py::dict record_of(const simulation::Gentleness::Record& one, bool fruit) {
  py::dict entry;
  entry["peak_force"] = one.peak_force;
  entry["impulse"] = one.impulse;
  entry["touched_at"] = one.touched() ? py::cast(one.first_touch) : py::none();
  entry["broken"] = one.broken;
  entry[fruit ? "margin_used" : "strain_energy"] = fruit ? one.margin_used : one.strain_energy;
  return entry;
}

py::dict dict_of(const simulation::Gentleness::Total& total) {
  py::dict all;
  all["peak_force"] = total.peak_force;
  all["impulse"] = total.impulse;
  all["margin_used"] = total.margin_used;
  all["strain_energy"] = total.strain_energy;
  all["touched"] = total.touched;
  all["broken"] = total.broken;
  return all;
}

py::dict gentleness_total(Run& self) {
  return dict_of(
      self.alone([](app::SteeredRun& one) { return one.simulation().gentleness().total(); }));
}

/// What was done to an organ or a fruit.
struct Handled {
  std::string name;
  bool fruit;
  simulation::Gentleness::Record record;
};

std::vector<Handled> handled(const simulation::Simulation& simulation) {
  std::vector<Handled> all;
  for (int p = 0; p < simulation.rods().size(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    for (std::size_t o = 0; o < model.organs.size(); ++o)
      all.push_back({model.organs[o], false, simulation.gentleness().organs(p)[o]});
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
      all.push_back({simulation::fruit_name(model, f), true,
                     simulation.gentleness().fruits(p)[static_cast<std::size_t>(f)]});
  }
  return all;
}

py::dict gentleness_of(Run& self) {
  const auto [total, organs] = self.alone([](app::SteeredRun& one) {
    return std::pair(one.simulation().gentleness().total(), handled(one.simulation()));
  });
  py::dict all = dict_of(total), by_name;
  for (const Handled& one : organs) by_name[one.name.c_str()] = record_of(one.record, one.fruit);
  all["organs"] = by_name;
  return all;
}

py::dict readings_of(Run& self, const world::InstrumentKind& kind) {
  const auto read = self.alone([&](app::SteeredRun& run) {
    std::vector<std::pair<std::string, Eigen::VectorXd>> all;
    for (const auto& one : run.simulation().instruments())
      if (&one->kind() == &kind) all.emplace_back(one->scene().name, one->reading());
    return all;
  });
  py::dict all;
  for (const auto& [name, reading] : read) all[name.c_str()] = array_of(reading);
  return all;
}

}  // namespace

void add_cameras(py::class_<Run>& run) {
  run.def_property_readonly(
      "gentleness", gentleness_of,
      "How gently the plants were handled so far, a dict: peak_force (N) and impulse (N s) of what "
      "touched them, margin_used (1, of the thresholds of stalks, at most), strain_energy (J, that "
      "was put in), touched and broken (how many), and organs: the same of each one by its name.");
  run.def_property_readonly("gentleness_total", gentleness_total,
                            "The same without the organs one by one, which is quicker.");
  for (const world::InstrumentKind& kind : world::instrument_kinds()) {
    std::string noun = kind.noun;
    noun[0] = static_cast<char>(std::toupper(noun[0]));
    run.def_property_readonly(
        kind.section.c_str(), [&kind](Run& self) { return readings_of(self, kind); },
        (noun + "s of the scene: a dict of names to (" + std::to_string(3 * kind.vectors.size()) +
         ",) arrays, " + kind.says + ", as they were last sampled, with their noise.")
            .c_str());
  }
  run.def("camera", &take, "camera"_a = "", "width"_a = py::none(), "height"_a = py::none(),
          "rgb"_a = true, "noise"_a = true, "fast"_a = false,
          "What a camera of the scene sees (empty: the first, or one that shows everything): a "
          "CameraPicture with colours, depths, masks and keypoints, in the camera's own size where "
          "none is given. Without `rgb` it is quicker; with `fast`, too: hard edges, no shadows, "
          "fewer facets. `noise`: the camera's own, its latency included; drawn from `seed`. "
          "Raises NoPictures where there is no OpenGL.");
  run.def_property_readonly(
      "things", [](Run& self) { return things_of(self.things()); },
      "Everything that pictures tell apart, by its id in instance masks.");
  run.def_property_readonly(
      "thing_classes",
      [](Run&) {
        std::vector<std::string> names;
        for (int c = 0; c < app::thing_classes; ++c)
          names.emplace_back(name_of(static_cast<app::ThingClass>(c)));
        return names;
      },
      "Classes of things, by their number in class masks.");
}

}  // namespace pedicel::python
