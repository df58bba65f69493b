#include "engine/cluster/local_queue.h"

#include <algorithm>
#include <thread>

namespace pedicel::cluster {

namespace {

std::size_t default_jobs(int threads) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return static_cast<std::size_t>(std::max(1, cores / std::max(1, threads)));
}

}  // namespace

LocalQueue::LocalQueue(RunFolder folder, const TaskHead& head, const ClusterOptions& options)
    : folder_(std::move(folder)),
      head_(head),
      scratch_(options.scratch),
      jobs_(options.jobs > 0 ? static_cast<std::size_t>(options.jobs)
                             : default_jobs(head.threads)) {}

void LocalQueue::submit(const std::vector<int>& blocks) {
  std::filesystem::create_directories(folder_.logs());
  waiting_.insert(waiting_.end(), blocks.begin(), blocks.end());
}

Queue::State LocalQueue::state() {
  std::erase_if(running_, [](const auto& process) { return process->ended(); });
  while (running_.size() < jobs_ && !waiting_.empty()) {
    const std::string block = std::to_string(waiting_.front());
    std::vector<std::string> words{head_.file.string(), "cluster", "task", folder_.path().string(),
                                   block};
    if (!scratch_.empty()) words.insert(words.end(), {"--scratch", scratch_.string()});
    const Process::Options options{{}, folder_.logs() / ("local_" + block + ".txt"), false};
    running_.push_back(std::make_unique<Process>(words, options));
    waiting_.pop_front();
  }
  return {true, static_cast<int>(running_.size()), static_cast<int>(waiting_.size())};
}

void LocalQueue::cancel() {
  waiting_.clear();
  for (const auto& process : running_) process->ask_to_end();
  running_.clear();
}

}  // namespace pedicel::cluster
