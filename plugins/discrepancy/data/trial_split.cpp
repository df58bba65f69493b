#include "plugins/discrepancy/data/trial_split.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace pedicel::discrepancy {

namespace {

std::string kind_of(const Trial& trial) {
  std::string kind;
  for (const Hold& hold : trial.holds) kind += std::isfinite(hold.release) ? "release " : "push ";
  if (!trial.loads.empty()) kind += "load ";
  if (trial.base) kind += "base ";
  return kind;
}

}  // namespace

TrialSplit split_trials(const Experiment& experiment) {
  TrialSplit split;
  std::vector<int> open;
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t) {
    const Trial::Use use = experiment.trials[t].use;
    if (use == Trial::Use::check) split.check.push_back(t);
    if (use == Trial::Use::fit) split.fit.push_back(t);
    if (use == Trial::Use::unset) open.push_back(t);
  }
  std::map<std::string, std::vector<int>> kinds;
  for (const int t : open) kinds[kind_of(experiment.trials[t])].push_back(t);
  std::vector<char> kept(experiment.trials.size(), 0);
  const std::size_t wanted = split.check.empty() ? open.size() / 3 : 0;
  std::size_t count = 0;
  for (bool found = true; found && count < wanted;) {
    found = false;
    // The second of a kind: the first is usually the plain one, from which a fit should start.
    for (auto& [kind, trials] : kinds) {
      if (trials.size() < 2 || count >= wanted) continue;
      kept[trials[1]] = 1;
      trials.erase(trials.begin() + 1);
      ++count;
      found = true;
    }
  }
  if (count == 0 && wanted > 0) kept[open.back()] = 1;
  for (const int t : open) (kept[t] ? split.check : split.fit).push_back(t);
  if (split.fit.empty()) std::swap(split.fit, split.check);
  return split;
}

bool exchange_trials(Experiment& experiment, const TrialSplit& split, int objecting) {
  std::vector<Trial>& trials = experiment.trials;
  const bool stated = std::ranges::any_of(
      trials, [](const Trial& trial) { return trial.use != Trial::Use::unset; });
  if (stated || split.fit.size() < 2) return false;
  const auto same = std::find_if(split.fit.rbegin(), split.fit.rend(), [&](int t) {
    return kind_of(trials[t]) == kind_of(trials[objecting]);
  });
  const int instead = same == split.fit.rend() ? split.fit.back() : *same;
  for (const int t : split.fit) trials[t].use = Trial::Use::fit;
  for (const int t : split.check) trials[t].use = Trial::Use::check;
  trials[objecting].use = Trial::Use::fit;
  trials[instead].use = Trial::Use::check;
  return true;
}

}  // namespace pedicel::discrepancy
