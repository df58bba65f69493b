#include "app/session/measured/diagnosis_job.h"

#include <algorithm>

namespace pedicel::app {

namespace {

constexpr double early = 0.05;  // share below which nothing can be said of the end

}  // namespace

void ProgressBoard::tell(const std::string& doing, double share) {
  const std::lock_guard lock(mutex_);
  progress_.doing = doing;
  progress_.share = std::max(progress_.share, std::clamp(share, 0.0, 1.0));
}

void ProgressBoard::note(const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  progress_.found.push_back(sentence);
}

DiagnosisProgress ProgressBoard::read() const {
  const std::lock_guard lock(mutex_);
  DiagnosisProgress now = progress_;
  now.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (now.share > early) now.left = now.seconds * (1.0 - now.share) / now.share;
  return now;
}

int threads_for_diagnosis(int threads) {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace pedicel::app
