#pragma once

#include <memory>
#include <string>

#include "app/verbs/experiment_run.h"
#include "engine/cluster/cluster_options.h"
#include "engine/core/files_read.h"
#include "plugins/discrepancy/fit/fit_parts.h"

namespace pedicel::app {

/// What the command line of `fit` and `diagnose` says of tasks: that there are to be some, or which
/// one this is.
struct PartArguments {
  cluster::ClusterOptions cluster;
  std::string part;     ///< "02_profiles:1/3": the second third of that stage; empty: no task
  std::string answers;  ///< file with the stages before it

  bool is_task() const { return !part.empty(); }
};
void add_part_options(CLI::App& verb, PartArguments& a);

/// Thrown in a task once its part is written: the search has no more to do there.
struct PartDone {};

/// Who does the parts of a search as the command line has it; null: this program. In a task, the
/// part goes to answers.json in `out`. With --cluster each stage is a run of its own below
/// out/cluster, and `inputs` are the files that it reads. Throws UsageError.
class SearchParts {
 public:
  SearchParts(PartArguments& a, const ExperimentArguments& experiment,
              const std::filesystem::path& out, const CLI::App& verb);
  ~SearchParts();
  discrepancy::FitParts* parts() const { return parts_.get(); }

 private:
  std::unique_ptr<discrepancy::FitParts> parts_;
};

}  // namespace pedicel::app
