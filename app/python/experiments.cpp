#include "pedicel/app/python/experiments.h"

#include <pybind11/stl.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <sstream>
#include <thread>

#include "pedicel/app/python/errors.h"
#include "pedicel/app/verbs/diagnose.h"
#include "pedicel/app/verbs/experiment_run.h"
#include "pedicel/app/verbs/observe.h"
#include "pedicel/app/verbs/parallel_worlds.h"
#include "pedicel/app/verbs/validate.h"
#include "pedicel/core/check.h"
#include "pedicel/discrepancy/fit/parameter_fit.h"
#include "pedicel/discrepancy/fit/parameter_request.h"
#include "pedicel/discrepancy/procedure/diagnosis.h"
#include "pedicel/io/atomic_file.h"
#include "pedicel/io/csv.h"
#include "pedicel/io/output_folder.h"

namespace pedicel::python {

namespace py = pybind11;
using namespace pybind11::literals;

namespace {

/// Runs a task on a thread of its own and listens to Ctrl-C meanwhile: then `stop` is set, and what
/// Python raises goes on once the task has ended.
template <class Task>
auto heard(std::atomic<bool>& stop, const Task& task) {
  std::future<decltype(task())> result = std::async(std::launch::async, task);
  bool interrupted = false;
  for (;;) {
    {
      const py::gil_scoped_release release;
      if (result.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready) break;
    }
    if (interrupted || PyErr_CheckSignals() == 0) continue;
    interrupted = true;
    stop = true;
  }
  if (!interrupted) return result.get();
  // The interrupt is what counts, whatever the task made of it.
  result.wait();
  throw py::error_already_set();
}

discrepancy::Experiment load(const std::string& path) {
  app::ExperimentArguments a;
  a.experiment = path;
  return app::load_experiment(a);
}

int cores(int threads) {
  app::ExperimentArguments a;
  a.threads = threads;
  return a.thread_count();
}

void set(discrepancy::DiagnosisSettings& settings, const std::map<std::string, double>& values) {
  for (const auto& [key, value] : values)
    discrepancy::set_setting(settings, key + "=" + io::exact_number(value));
}

std::string diagnose(const std::string& experiment, const std::string& out, int threads,
                     std::uint64_t seed, std::optional<double> time_limit,
                     const std::map<std::string, double>& settings) {
  std::atomic<bool> stop{false};
  return heard(stop, [&] {
    const discrepancy::Experiment measured = load(experiment);
    discrepancy::DiagnosisOptions options;
    set(options.settings, settings);
    options.threads = cores(threads);
    options.seed = seed;
    options.stop = &stop;
    if (time_limit) options.time_limit = *time_limit;
    options.cut_short = [&stop] { stop = false; };
    discrepancy::Diagnosis diagnosis = discrepancy::diagnose(measured, options);
    if (!out.empty())
      io::write_folder(out, [&](const std::filesystem::path& in) {
        app::write_diagnosis(in, measured, diagnosis);
      });
    return to_json(diagnosis.verdict);
  });
}

std::string fit(const std::string& experiment, const std::vector<std::string>& parameters,
                const std::string& out, int threads, std::uint64_t seed) {
  std::atomic<bool> stop{false};
  return heard(stop, [&] {
    const discrepancy::Experiment measured = load(experiment);
    const auto starts = discrepancy::requested_starts(measured, parameters);
    discrepancy::ParameterFitOptions options;
    options.threads = cores(threads);
    options.seed = seed;
    options.stop = &stop;
    const discrepancy::ParameterFit fit = fit_parameters(measured, starts, options);
    if (!out.empty() && !fit.stopped)
      io::write_folder(out, [&](const std::filesystem::path& in) {
        plant::write_plant_file(in / "fitted.plant.yaml",
                                discrepancy::extended_plant(measured, fit.summary.hypothesis));
        io::write_file_atomically(in / "fit.json", to_json(fit) + "\n");
      });
    return to_json(fit);
  });
}

discrepancy::Experiment observed(const app::ObserveArguments& a) {
  try {
    return app::observed(a, load(a.like));
  } catch (const app::UnstableWorld& fault) {
    throw Unstable(fault.what());
  }
}

void observe(const app::ObserveArguments& a) {
  std::atomic<bool> stop{false};
  heard(stop, [&] {
    const discrepancy::Experiment experiment = observed(a);
    io::write_folder(a.out, [&](const std::filesystem::path& in) {
      discrepancy::write_experiment(in, experiment);
    });
    return 0;
  });
}

}  // namespace

void add_experiments(py::module_& module) {
  module.def("diagnose", &diagnose, "experiment"_a, "out"_a, "threads"_a, "seed"_a, "time_limit"_a,
             "settings"_a);
  module.def("fit", &fit, "experiment"_a, "parameters"_a, "out"_a, "threads"_a, "seed"_a);
  module.def(
      "observe",
      [](const std::string& model, const std::string& like, const std::string& out,
         const std::string& plant, std::uint64_t seed, double noise_position, double noise_force,
         double noise_colour, const std::vector<std::string>& effects) {
        app::ObserveArguments a;
        a.model = model, a.like = like, a.out = out, a.plant = plant, a.seed = seed;
        a.noise_position = noise_position, a.noise_force = noise_force;
        a.noise_colour = noise_colour, a.set = effects;
        observe(a);
      },
      "model"_a, "like"_a, "out"_a, "plant"_a, "seed"_a, "noise_position"_a, "noise_force"_a,
      "noise_colour"_a, "effects"_a);
  module.def(
      "validate",
      [](const std::vector<std::string>& files, const std::vector<std::string>& packages) {
        const py::gil_scoped_release release;
        std::ostringstream text;
        const int code = app::validate_files(files, packages, text);
        return std::pair{code == 0, text.str()};
      },
      "files"_a, "packages"_a);
}

}  // namespace pedicel::python
