#include <pybind11/stl.h>

#include <optional>

#include "app/python/run_class.h"
#include "app/python/scenes.h"
#include "app/steer/steered_worlds.h"
#include "engine/core/check.h"
#include "engine/core/timer.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

using Mask = py::array_t<bool, py::array::c_style | py::array::forcecast>;

struct Worlds {
  explicit Worlds(std::unique_ptr<app::SteeredWorlds> made)
      : all(*made),
        built(std::move(made), all.threads() > 1),
        sensed(static_cast<std::size_t>(all.size())) {
    for (RunSensors& one : sensed) one.seed = all.run(0).scene().assets->scene.seed;
  }
  app::SteeredWorlds& all;
  Threaded<app::SteeredWorlds> built;
  std::mutex mutex;
  std::vector<RunSensors> sensed;  // by world
};

/// One of them; Python keeps the others alive with it.
class World : public Run {
 public:
  World(Worlds& worlds, int world) : worlds_(worlds), world_(world) {}
  app::SteeredRun& run() override { return worlds_.all.run(world_); }
  app::StateArrays& state() override { return worlds_.all.state(); }
  std::mutex& mutex() override { return worlds_.mutex; }
  void check_process() const override { worlds_.built.check("a world of Worlds"); }
  RunSensors& sensed() override { return worlds_.sensed[static_cast<std::size_t>(world_)]; }
  int world() const override { return world_; }
  void fill_all() override { worlds_.all.fill(); }

 private:
  Worlds& worlds_;
  int world_;
};

std::unique_ptr<Worlds> make_worlds(const py::object& scene, int count, int threads,
                                    const py::dict& plants,
                                    const std::vector<std::string>& packages,
                                    const py::kwargs& settings) {
  if (threads < 0)
    throw UsageError("threads = " + std::to_string(threads) +
                     ": expected 1 or more, or 0: all cores");
  const auto built = make_scene(scene, plants, packages, settings);
  const py::gil_scoped_release release;
  return std::make_unique<Worlds>(std::make_unique<app::SteeredWorlds>(built, count, threads));
}

std::vector<std::uint8_t> marks(Worlds& self, const std::optional<Mask>& mask) {
  if (!mask) return {};
  if (mask->ndim() != 1 || mask->size() != self.all.size())
    throw UsageError("mask: has " + std::to_string(mask->size()) + " marks, expected " +
                     std::to_string(self.all.size()) + ", one a world");
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(self.all.size()));
  for (int w = 0; w < self.all.size(); ++w) marks[static_cast<std::size_t>(w)] = mask->at(w);
  return marks;
}

void step(Worlds& self, long count, const std::optional<Mask>& mask) {
  constexpr double heard = 0.25;  // s, after which Ctrl-C is heard
  constexpr long least = 32;      // steps between two looks: worlds wait for each other there
  if (count < 0) throw UsageError("step(" + std::to_string(count) + "): expected 0 steps or more");
  self.built.check("a Worlds");
  const std::vector<std::uint8_t> marked = marks(self, mask);
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  const auto stepped = [&self](int world) {
    self.sensed[static_cast<std::size_t>(world)].remember(self.all.run(world));
  };
  for (long most = least; count > 0;) {
    const long now = std::min(count, most);
    const Timer since;
    self.all.step(now, marked, stepped);
    count -= now;
    const double seconds = since.seconds();
    most = std::max(least, std::lround(static_cast<double>(now) * heard / std::max(seconds, 1e-6)));
    if (count == 0) return;
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void reset(Worlds& self, const std::optional<Mask>& mask) {
  self.built.check("a Worlds");
  const std::vector<std::uint8_t> marked = marks(self, mask);
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  self.all.reset(marked);
}

void act(Worlds& self, app::Act::Kind kind, const Numbers& values) {
  const auto joints = static_cast<py::ssize_t>(self.all.state().layout().rows(app::Rows::joint));
  if (values.ndim() != 2 || values.shape(0) != self.all.size() || values.shape(1) != joints)
    throw UsageError("values: expected an array of " + std::to_string(self.all.size()) +
                     " worlds x " + std::to_string(joints) + " joints");
  self.built.check("a Worlds");
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  for (int w = 0; w < self.all.size(); ++w)
    self.all.run(w).act({0, kind, "", {values.data(w, 0), values.data(w, 0) + joints}});
}

void add_state(py::class_<Worlds>& worlds) {
  const auto all = simulation::quantities();
  for (std::size_t q = 0; q < all.size(); ++q) {
    if (all[q].name.empty()) continue;
    worlds.def_property_readonly(
        std::string(all[q].name).c_str(),
        [q](const py::object& self) {
          Worlds& one = self.cast<Worlds&>();
          if (one.all.state().want(q)) {
            one.built.check("a Worlds");
            const py::gil_scoped_release release;
            const std::lock_guard lock(one.mutex);
            one.all.fill();
          }
          return worlds_view(one.all.state(), q, self);
        },
        words_of(all[q], true).c_str());
  }
}

void add_targets(py::class_<Worlds>& worlds) {
  const auto targets = [&](const char* name, app::Act::Kind kind, const char* words) {
    worlds.def(
        name, [kind](Worlds& self, const Numbers& values) { act(self, kind, values); }, "values"_a,
        words);
  };
  targets("set_joint_positions", app::Act::Kind::position,
          "(worlds, joints): targets of all worlds, rad or m; nan: as it is.");
  targets("set_joint_velocities", app::Act::Kind::velocity,
          "(worlds, joints): likewise, rad/s or m/s.");
  targets("set_joint_torques", app::Act::Kind::torque, "(worlds, joints): likewise, N m or N.");
}

/// As an array of a number a world.
template <class Number, class Read>
py::array_t<Number> each(Worlds& self, const Read& read) {
  py::array_t<Number> numbers(static_cast<py::ssize_t>(self.all.size()));
  Number* to = numbers.mutable_data();
  const py::gil_scoped_release release;
  const std::lock_guard lock(self.mutex);
  for (int w = 0; w < self.all.size(); ++w) to[w] = read(self.all.run(w));
  return numbers;
}

World* one_of(Worlds& self, int world) {
  const int count = self.all.size(), index = world < 0 ? world + count : world;
  if (index < 0 || index >= count)
    throw py::index_error("there are " + std::to_string(count) + " worlds");
  return new World(self, index);
}

}  // namespace

void add_worlds_class(py::module_& module) {
  py::class_<World, Run>(module, "World", "One of several Worlds; `worlds[i]`.");
  py::class_<Worlds> worlds(
      module, "Worlds",
      "Many independent worlds of one scene, stepped on all cores with one call.\n\n"
      "Arguments as for Simulation. threads 0: all cores. Arrays have an axis of worlds in front. "
      "The same acts give the same bits as in a Simulation with threads=1.");
  worlds
      .def(py::init(&make_worlds), "scene"_a, "count"_a, py::kw_only(), "threads"_a = 0,
           "plants"_a = py::dict(), "packages"_a = std::vector<std::string>{})
      .def("__len__", [](Worlds& self) { return self.all.size(); })
      .def("__getitem__", one_of, py::keep_alive<0, 1>(), "world"_a)
      .def("step", &step, "count"_a = 1, "mask"_a = py::none(),
           "So many steps in every world, or in those whose mask (worlds,) is true. A world that "
           "can go no further stops; `failed` says which.")
      .def("reset", &reset, "mask"_a = py::none(),
           "To time 0, every world or those whose mask (worlds,) is true.")
      .def_property_readonly(
          "failed",
          [](Worlds& self) {
            return each<bool>(self, [](app::SteeredRun& run) { return run.failed(); });
          },
          "(worlds,) bool: can go no further.")
      .def_property_readonly(
          "times",
          [](Worlds& self) {
            return each<double>(
                self, [](app::SteeredRun& run) { return run.simulation().world().time(); });
          },
          "(worlds,), s: simulated time.")
      .def_property_readonly(
          "threads", [](Worlds& self) { return self.all.threads(); },
          "Threads that share the worlds.");
  add_state(worlds);
  add_targets(worlds);
}

}  // namespace pedicel::python
