#include "app/session/measured/experiment_reading.h"

#include "plugins/discrepancy/files/experiment_files.h"

namespace pedicel::app {

ExperimentReading::ExperimentReading(std::filesystem::path path)
    : path_(std::move(path)), job_([this](const std::atomic<bool>& stop) {
        const auto progress = [this, &stop](int done, int all) {
          done_ = done, all_ = all;
          return !stop;
        };
        experiment_ = discrepancy::read_experiment(path_, diagnostics_, {.progress = progress});
      }) {}

}  // namespace pedicel::app
