#include "app/verbs/part_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/verbs/cluster.h"
#include "engine/core/check.h"
#include "engine/core/stop.h"
#include "engine/io/atomic_file.h"

namespace pedicel::app {

namespace {

namespace fs = std::filesystem;
using Answers = std::map<std::string, std::vector<std::string>>;  // by stage

// Each task does the search up to its part again, so a stage is not cut into ever smaller ones.
constexpr int most_groups = 16;
constexpr const char* answers_name = "answers.json";

Answers read_answers(const fs::path& file) {
  try {
    return nlohmann::json::parse(io::read_file(file)).get<Answers>();
  } catch (const nlohmann::json::exception& fault) {
    throw InvalidFile({file.string()}, std::string("has no answers: ") + fault.what());
  }
}

/// "01_starts", "02_profiles": searches come to their stages in the same order everywhere.
class Stages : public discrepancy::FitParts {
 protected:
  std::string next(const std::string& stage) {
    char number[16];
    std::snprintf(number, sizeof number, "%02d_", ++count_);
    return number + stage;
  }

 private:
  int count_ = 0;
};

/// A task: what is known is taken, its own part is done, and that is the end of it.
class OnePart : public Stages {
 public:
  OnePart(const PartArguments& a, fs::path out) : out_(std::move(out)) {
    if (!a.answers.empty()) known_ = read_answers(a.answers);
    int used = 0;
    char stage[64] = "";
    if (std::sscanf(a.part.c_str(), "%63[^:]:%d/%d%n", stage, &group_, &groups_, &used) != 3 ||
        std::cmp_not_equal(used, a.part.size()) || groups_ < 1 || group_ < 0 || group_ >= groups_)
      throw UsageError("--part " + a.part + ": expected STAGE:GROUP/GROUPS, as 01_starts:0/3");
    stage_ = stage;
  }

  std::vector<std::string> answers(const std::string& stage, int count,
                                   const std::function<std::string(int)>& compute) override {
    const std::string name = next(stage);
    if (const auto found = known_.find(name); found != known_.end()) {
      if (std::cmp_not_equal(found->second.size(), count))
        throw UsageError("--answers: " + name + " has " + std::to_string(found->second.size()) +
                         " answers, expected " + std::to_string(count));
      return found->second;
    }
    if (name != stage_)
      throw UsageError("--part " + stage_ + ": the search came to " + name +
                       ", whose answers are not known, before");
    nlohmann::json mine = nlohmann::json::object();
    for (int i = group_; i < count; i += groups_) mine[std::to_string(i)] = compute(i);
    throw_if_stopped();
    io::write_file_atomically(out_ / answers_name, mine.dump() + "\n");
    throw PartDone{};
  }

 private:
  fs::path out_;
  Answers known_;
  std::string stage_;
  int group_ = 0, groups_ = 1;
};

/// The verb's own call: a stage is a run of tasks.
class HandedIn : public Stages {
 public:
  HandedIn(const PartArguments& a, const ExperimentArguments& experiment, fs::path out,
           const CLI::App& verb)
      : options_(a.cluster), experiment_(experiment), out_(std::move(out)), verb_(verb) {}

  std::vector<std::string> answers(const std::string& stage, int count,
                                   const std::function<std::string(int)>&) override {
    // All is read by now; what comes later are answers.
    if (files_.empty()) files_ = inputs_.files();
    const std::string name = next(stage);
    const int groups = std::clamp(options_.jobs > 0 ? options_.jobs : most_groups, 1,
                                  std::max(1, std::min(count, most_groups)));
    const fs::path answers = fs::absolute(out_) / "cluster" / name / answers_name;
    io::write_file_atomically(answers, nlohmann::json(known_).dump() + "\n");
    const auto campaign =
        run_campaign(out_, name, plan(name, groups, answers), options_, experiment_.quiet);
    throw_if_stopped();
    if (!campaign->missing_text().empty())
      throw std::runtime_error("the stage " + name + " is not complete");
    known_[name] = merged(*campaign, groups, count);
    return known_[name];
  }

 private:
  cluster::Plan plan(const std::string& stage, int groups, const fs::path& answers) const {
    cluster::Plan plan;
    plan.verb = verb_.get_name();
    plan.common = cluster::words_of(
        verb_, {"--out", "--json", "--quiet", "--verbose", "--time-limit", "--instruction-set"});
    plan.common.insert(plan.common.end(),
                       {"--quiet", "--out={out}", "--answers=" + answers.string()});
    if (experiment_.threads == 0) plan.common.emplace_back("--threads=1");
    plan.again = cluster::words_of_same_call(verb_);
    plan.inputs = files_;
    plan.inputs.push_back(answers);
    plan.threads = std::max(1, experiment_.threads);
    const CLI::Option* set = verb_.get_option("--instruction-set");
    if (set->count() > 0) plan.instruction_set = set->results().front();
    for (int i = 0; i < groups; ++i) {
      const std::string part = stage + ":" + std::to_string(i) + "/" + std::to_string(groups);
      plan.cases.push_back({part, {"--part=" + part}});
    }
    return plan;
  }

  static std::vector<std::string> merged(const cluster::Campaign& campaign, int groups, int count) {
    std::vector<std::string> all(count);
    for (int group = 0; group < groups; ++group) {
      const fs::path file = *campaign.output(group) / answers_name;
      try {
        const auto json = nlohmann::json::parse(io::read_file(file));
        for (int i = group; i < count; i += groups)
          all[i] = json.at(std::to_string(i)).get<std::string>();
      } catch (const nlohmann::json::exception& fault) {
        throw InvalidFile({file.string()}, std::string("has no answers: ") + fault.what());
      }
    }
    return all;
  }

  FilesRead inputs_;  // from now on
  std::vector<fs::path> files_;
  cluster::ClusterOptions options_;
  const ExperimentArguments& experiment_;
  fs::path out_;
  const CLI::App& verb_;
  Answers known_;
};

}  // namespace

void add_part_options(CLI::App& verb, PartArguments& a) {
  cluster::add_cluster_options(verb, a.cluster);
  verb.add_option("--part", a.part, "only this part of the search: what a task of --cluster calls");
  verb.add_option("--answers", a.answers, "file with the parts that are done, for --part");
}

SearchParts::SearchParts(PartArguments& a, const ExperimentArguments& experiment,
                         const fs::path& out, const CLI::App& verb) {
  a.cluster = cluster::with_profile(a.cluster);
  if (a.cluster.no_wait || a.cluster.collect_only)
    throw UsageError(std::string(a.cluster.no_wait ? "--no-wait" : "--collect-only") +
                     ": each stage of a search needs the one before it, expected it without");
  if (a.is_task() && a.cluster.wanted())
    throw UsageError("--part and --cluster: expected one of them");
  if (!a.is_task() && !a.answers.empty()) throw UsageError("--answers: expected it with --part");
  if (a.is_task()) parts_ = std::make_unique<OnePart>(a, out);
  if (a.cluster.wanted()) parts_ = std::make_unique<HandedIn>(a, experiment, out, verb);
}

SearchParts::~SearchParts() = default;

}  // namespace pedicel::app
