#include "pedicel/app/session/measured/diagnosis_job.h"

#include <algorithm>

namespace pedicel::app {

namespace {

constexpr double early = 0.05;  // share below which nothing can be said of the end

}  // namespace

DiagnosisJob::DiagnosisJob(std::shared_ptr<const discrepancy::Experiment> experiment, int threads,
                           std::uint64_t seed)
    : job_([this, experiment = std::move(experiment), threads,
            seed](const std::atomic<bool>& stop) { work(*experiment, threads, seed, stop); }) {}

void DiagnosisJob::work(const discrepancy::Experiment& experiment, int threads, std::uint64_t seed,
                        const std::atomic<bool>& stop) {
  discrepancy::DiagnosisOptions options;
  options.threads = threads;
  options.seed = seed;
  options.stop = &stop;
  options.progress = [this](const std::string& doing, double share) {
    const std::lock_guard lock(mutex_);
    progress_.doing = doing;
    progress_.share = std::max(progress_.share, std::clamp(share, 0.0, 1.0));
  };
  options.note = [this](const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    progress_.found.push_back(sentence);
  };
  auto found =
      std::make_shared<const discrepancy::Diagnosis>(discrepancy::diagnose(experiment, options));
  const std::lock_guard lock(mutex_);
  if (!found->stopped) result_ = std::move(found);
}

DiagnosisProgress DiagnosisJob::progress() const {
  const std::lock_guard lock(mutex_);
  DiagnosisProgress now = progress_;
  now.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (now.share > early) now.left = now.seconds * (1.0 - now.share) / now.share;
  return now;
}

std::shared_ptr<const discrepancy::Diagnosis> DiagnosisJob::result() const {
  const std::lock_guard lock(mutex_);
  return result_;
}

}  // namespace pedicel::app
