#include "app/session/measured/background_job.h"

#include <exception>

namespace pedicel::app {

BackgroundJob::BackgroundJob(Work work) : thread_([this, work = std::move(work)] { run(work); }) {}

BackgroundJob::~BackgroundJob() {
  stop();
  thread_.join();
}

void BackgroundJob::run(const Work& work) {
  try {
    work(stop_);
  } catch (const std::exception& fault) {
    fault_ = fault.what();
  }
  ended_ = true;
}

}  // namespace pedicel::app
