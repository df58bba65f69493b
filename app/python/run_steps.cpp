#include <pybind11/numpy.h>

#include "app/draw/tint.h"
#include "app/python/errors.h"
#include "app/python/picture_thread.h"
#include "app/python/run_class.h"
#include "app/python/scenes.h"
#include "engine/core/check.h"
#include "engine/core/timer.h"

namespace pedicel::python {

namespace py = pybind11;

long checked_seed(long seed) {
  if (seed >= 0) return seed;
  throw UsageError("seed is " + std::to_string(seed) + ", expected a whole number from 0 on");
}

void Run::step(long count) {
  constexpr double heard = 0.1;  // s, after which Ctrl-C is heard
  if (count < 0) throw UsageError("step(" + std::to_string(count) + "): expected 0 steps or more");
  check_process();
  const py::gil_scoped_release release;
  const std::lock_guard lock(mutex());
  Timer since;
  bool good = !run().failed();
  for (long i = 0; i < count && good; ++i) {
    good = run().step();
    sensed().remember(run());
    if (since.seconds() < heard) continue;
    since.restart();
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() == 0) continue;
    fill();
    throw py::error_already_set();
  }
  fill();
  if (!good) throw Unstable(run().failure());
}

void Run::reset(const std::optional<long>& wanted_seed, const py::dict& settings) {
  if (wanted_seed) sensed().seed = checked_seed(*wanted_seed);
  app::SteeredScene::Settings texts = settings_of(settings);
  alone([&](app::SteeredRun& one) {
    // What the scene draws is drawn anew; without it a seed changes nothing, and costs nothing.
    const world::Scene& scene = *one.scene().files.scene;
    if (wanted_seed && (!scene.vary.empty() || !scene.instruments.empty()))
      texts.insert(texts.begin(), {"seed", std::to_string(*wanted_seed % 1000000000)});
    // Refused settings leave it at time 0, too.
    try {
      one.reset(texts);
    } catch (...) {
      fill();
      throw;
    }
    fill();
  });
}

void Run::act(app::Act act) {
  alone([&](app::SteeredRun& one) { one.act(std::move(act)); });
}

namespace {

void check_camera(const simulation::Simulation& simulation, const std::string& camera) {
  if (camera.empty()) return;
  std::vector<std::string> names;
  for (const world::SceneCamera& one : simulation.scene().cameras) {
    if (one.name == camera) return;
    names.push_back(one.name);
  }
  throw UsageError("no camera " + in_quotes(camera) +
                   ", expected one of: " + simulation::list_of(names));
}

}  // namespace

app::SceneSensors& RunSensors::of(app::SteeredRun& run) {
  if (!of_run || generation != run.generation())
    of_run = std::make_unique<app::SceneSensors>(run.simulation());
  generation = run.generation();
  return *of_run;
}

void RunSensors::remember(app::SteeredRun& run) {
  if (of_run && generation == run.generation()) of_run->remember();
}

app::SensedPicture Run::sense(const app::SenseRequest& wanted) {
  std::optional<app::SensedPicture> picture;
  alone([&](app::SteeredRun& one) {
    app::SceneSensors& sensors = sensed().of(one);
    PictureThread::get().run([&](app::PictureTaker& taker) {
      picture = sensors.take(taker, wanted, static_cast<std::uint64_t>(sensed().seed));
    });
  });
  return std::move(*picture);
}

std::vector<app::NamedThing> Run::things() {
  return alone([&](app::SteeredRun& one) {
    const auto all = sensed().of(one).things().all();
    return std::vector<app::NamedThing>(all.begin(), all.end());
  });
}

py::array_t<std::uint8_t> Run::render(const std::string& camera, int width, int height, bool strain,
                                      bool text) {
  std::optional<render::Image> image;
  alone([&](app::SteeredRun& one) {
    check_camera(one.simulation(), camera);
    app::SceneView& view = sensed().of(one).view();
    app::Frame frame;
    view.fill(frame, strain);
    if (!text) frame.caption.clear(), frame.note.clear(), frame.legend.reset();
    const render::Camera from = view.camera(camera, frame);
    PictureThread::get().run([&](app::PictureTaker& taker) {
      taker.set(app::light_of(one.simulation().scene().look));
      image = taker.take(frame, from, width, height);
    });
  });
  py::array_t<std::uint8_t> pixels({height, width, 3});
  std::copy(image->rgb.begin(), image->rgb.end(), pixels.mutable_data());
  return pixels;
}

}  // namespace pedicel::python
