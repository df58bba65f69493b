#include "app/session/measured/experiment_reading.h"

#include "plugins/discrepancy/data/experiment_progress.h"
#include "plugins/discrepancy/scene_files/scene_experiment_reader.h"

namespace pedicel::app {

ExperimentReading::ExperimentReading(std::filesystem::path path)
    : path_(std::move(path)), job_([this](const std::atomic<bool>& stop) {
        if (discrepancy::is_scene_experiment(path_)) {
          scene_experiment_ = discrepancy::read_scene_experiment(path_, diagnostics_);
          if (stop) scene_experiment_.reset();
          return;
        }
        experiment_ =
            discrepancy::read_experiment(path_, diagnostics_, [this, &stop](int done, int all) {
              done_ = done, all_ = all;
              return !stop;
            });
      }) {}

}  // namespace pedicel::app
