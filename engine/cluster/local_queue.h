#pragma once

#include <deque>
#include <memory>

#include "engine/cluster/cluster_options.h"
#include "engine/cluster/job_list.h"
#include "engine/cluster/process.h"
#include "engine/cluster/queue.h"

namespace pedicel::cluster {

/// Processes of this machine, a block each, so many at a time.
class LocalQueue : public Queue {
 public:
  LocalQueue(RunFolder folder, const TaskHead& head, const ClusterOptions& options);

  void check() override {}
  void submit(const std::vector<int>& blocks) override;
  State state() override;
  void cancel() override;
  std::string left() const override { return {}; }
  double interval() const override { return 0.02; }

 private:
  RunFolder folder_;
  const TaskHead& head_;
  std::filesystem::path scratch_;
  std::size_t jobs_ = 1;
  std::deque<int> waiting_;
  std::vector<std::unique_ptr<Process>> running_;
};

}  // namespace pedicel::cluster
