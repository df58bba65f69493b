#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/cluster/cluster_options.h"
#include "engine/cluster/job_list.h"
#include "engine/cluster/queue.h"

namespace pedicel::cluster {

/// Job arrays of Slurm, one task a block. What was handed in stands in the run's folder, so that
/// another shell can take it up.
class SlurmQueue : public Queue {
 public:
  SlurmQueue(RunFolder folder, const TaskHead& head, const ClusterOptions& options);

  void check() override;
  void submit(const std::vector<int>& blocks) override;
  State state() override;
  void cancel() override;
  std::string left() const override;
  double interval() const override { return 2.0; }

 private:
  void write_script() const;
  void hurry(const std::string& task);
  std::vector<std::string> command(const std::vector<int>& indices, int offset) const;

  RunFolder folder_;
  const TaskHead& head_;
  ClusterOptions options_;
  JobList jobs_;
  std::set<std::string> hurried_;  // tasks
};

}  // namespace pedicel::cluster
