#include "app/verbs/dataset_tasks.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/dataset/data_set_files.h"
#include "app/verbs/cluster.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/core/timer.h"

namespace pedicel::app {

namespace {

long parts_of(const DataSetOptions& options) {
  return (options.count + pictures_of_case - 1) / pictures_of_case;
}

/// --count stands in each case, so that a larger set finds the cases of a smaller one.
cluster::Plan plan_of_pictures(const DataSetOptions& options, const CLI::App& verb,
                               const FilesRead& inputs) {
  cluster::Plan plan;
  plan.verb = verb.get_name();
  plan.common =
      cluster::words_of(verb, {"--out", "--count", "--json", "--quiet", "--instruction-set"});
  plan.common.insert(plan.common.end(), {"--quiet", "--out={out}"});
  plan.again = cluster::words_of_same_call(verb);
  plan.inputs = inputs.files();
  const CLI::Option* set = verb.get_option("--instruction-set");
  if (set->count() > 0) plan.instruction_set = set->results().front();
  plan.threads = std::max(1, options.scene.threads);
  for (int i = 0; i < parts_of(options); ++i) {
    const DataSetOptions part = options_of_part(options, i);
    plan.cases.push_back(
        {"pictures " + std::to_string(part.first) + " to " + std::to_string(part.count - 1),
         {"--part=" + std::to_string(i), "--count=" + std::to_string(part.count)}});
  }
  return plan;
}

}  // namespace

DataSetOptions options_of_part(DataSetOptions options, int part) {
  if (part >= parts_of(options))
    throw UsageError("--part " + std::to_string(part) + ": the set has " +
                     std::to_string(parts_of(options)) +
                     " parts, expected one from 0 on below that");
  options.first = part * pictures_of_case;
  options.count = std::min(options.count, options.first + pictures_of_case);
  return options;
}

DataSetResult make_data_set_as_tasks(const DataSetOptions& options, const CLI::App& verb,
                                     const cluster::ClusterOptions& cluster,
                                     const FilesRead& inputs, bool& whole) {
  const Timer timer;
  // Built once: what cannot be built is found before any task, and its files come to the list. As
  // the scene is without what varies: a draw that cannot stand is left out in its own turn.
  world::Scene plain = options.scene;
  plain.vary.clear();
  { const simulation::Simulation simulation(plain, options.simulation); }
  const io::FolderLock lock = take_data_set_folder(options);
  const long before = end_data_set(options).pictures;
  const cluster::Plan plan = plan_of_pictures(options, verb, inputs);
  const auto campaign = run_campaign(options.out, "", plan, cluster, options.quiet);
  for (std::size_t i = 0; i < plan.cases.size(); ++i)
    if (const auto from = campaign->output(static_cast<int>(i))) take_pictures(*from, options);
  whole = campaign->missing_text().empty();
  DataSetResult result = end_data_set(options);
  result.made = result.pictures - before;
  result.seconds = timer.seconds();
  return result;
}

}  // namespace pedicel::app
