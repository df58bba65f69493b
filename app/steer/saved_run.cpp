#include "app/steer/saved_run.h"

#include <cinttypes>
#include <cstdio>
#include <sstream>

#include "engine/core/check.h"

namespace pedicel::app {

namespace {

constexpr const char* head = "pedicel-run 1";

}  // namespace

std::string to_text(const SavedRun& saved) {
  char line[120];
  std::snprintf(line, sizeof line, "%s\n%016" PRIx64 " %016" PRIx64 " %ld %zu\n", head, saved.model,
                saved.state, saved.steps, saved.acts.size());
  std::string text = line;
  for (const Act& act : saved.acts) text += to_text(act) + "\n";
  return text;
}

SavedRun saved_run_of_text(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != head)
    throw UsageError(std::string("this is no saved run: expected what Simulation.save() gave (") +
                     head + ")");
  SavedRun saved;
  std::size_t acts = 0;
  if (!std::getline(lines, line) ||
      std::sscanf(line.c_str(), "%" SCNx64 " %" SCNx64 " %ld %zu", &saved.model, &saved.state,
                  &saved.steps, &acts) != 4 ||
      saved.steps < 0)
    throw UsageError("a saved run is damaged: expected two hashes, steps and a count");
  while (std::getline(lines, line)) saved.acts.push_back(act_of_text(line));
  if (saved.acts.size() != acts)
    throw UsageError("a saved run is cut off: it has " + std::to_string(saved.acts.size()) +
                     " acts, expected " + std::to_string(acts));
  return saved;
}

}  // namespace pedicel::app
