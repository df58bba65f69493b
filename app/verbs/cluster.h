#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "app/verbs/experiment_run.h"
#include "engine/cluster/campaign.h"
#include "engine/io/output_folder.h"

namespace CLI {
class App;
}

namespace pedicel::app {

/// What this program says of itself to tasks.
cluster::ProgramAbout program_about();

/// --instruction-set, which counts from when it is parsed.
void add_instruction_set_option(CLI::App& verb);

/// Runs a campaign with a line of progress, and says what is missing at the end. `out` is the
/// verb's own folder; the campaign's is out/cluster, or out/cluster/`stage`. Throws as Campaign
/// does.
std::unique_ptr<cluster::Campaign> run_campaign(const std::filesystem::path& out,
                                                const std::string& stage, const cluster::Plan& plan,
                                                const cluster::ClusterOptions& options, bool quiet);

/// Puts the files of a case into a folder of the run that it is a part of, as if they had been
/// written there: by a link where both are on one disk. `left_out` is not put there.
void place_files(const std::filesystem::path& from, io::OutputFolder& to,
                 const std::string& left_out);

/// `pedicel cluster ACTION FOLDER`: looks at a run that was handed in, takes it up again, merges
/// it, cancels it; and does one of its tasks. Adds the verb to the command line.
std::function<int()> add_cluster_verb(CLI::App& app);

}  // namespace pedicel::app
