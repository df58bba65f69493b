#include <pybind11/stl.h>

#include "app/python/run_class.h"
#include "app/python/scenes.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

class Simulation : public Run {
 public:
  explicit Simulation(const std::shared_ptr<const app::SteeredScene>& scene)
      : run_(std::make_unique<app::SteeredRun>(scene), scene->assets->scene.threads > 1),
        state_(app::RowLayout(run_->simulation()), 1) {
    sensed_.seed = scene->assets->scene.seed;
    fill();
  }
  app::SteeredRun& run() override { return *run_; }
  app::StateArrays& state() override { return state_; }
  std::mutex& mutex() override { return mutex_; }
  void check_process() const override { run_.check("a Simulation"); }
  RunSensors& sensed() override { return sensed_; }

 private:
  Threaded<app::SteeredRun> run_;
  app::StateArrays state_;
  std::mutex mutex_;
  RunSensors sensed_;
};

std::unique_ptr<Simulation> make_simulation(const py::object& scene, const py::dict& plants,
                                            const std::vector<std::string>& packages,
                                            const py::kwargs& settings) {
  const auto built = make_scene(scene, plants, packages, settings);
  const py::gil_scoped_release release;
  return std::make_unique<Simulation>(built);
}

}  // namespace

void add_simulation_class(py::module_& module) {
  py::class_<Simulation, Run>(
      module, "Simulation",
      "One simulation of a scene.\n\n"
      "scene: path of a scene (*.scene.yaml) or of a plant, or a Plant. plants: Plant objects that "
      "take the place of the scene's plants, by name. packages: \"NAME=PATH\" of package:// names. "
      "settings: keys of `--set`, as dt=0.002 or **{\"detach.stretch\": 0.2}. Raises InvalidFile "
      "and "
      "UsageError.")
      .def(py::init(&make_simulation), "scene"_a, py::kw_only(), "plants"_a = py::dict(),
           "packages"_a = std::vector<std::string>{});
}

}  // namespace pedicel::python
