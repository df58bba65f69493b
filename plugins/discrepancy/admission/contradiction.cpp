#include "plugins/discrepancy/admission/contradiction.h"

#include <algorithm>
#include <array>
#include <list>
#include <span>
#include <utility>

#include "plugins/discrepancy/admission/contradiction_checks.h"

namespace pedicel::discrepancy {

namespace {

/// What a check takes for granted, beside the rest.
enum class Needs {
  nothing,
  time,  ///< rows at times: not the rows of a static series
  rest,  ///< and a plant that rests until something is done
};
// What a check takes for granted stands beside it here, so that no check has to ask for itself, and
// none forgets to.
struct Question {
  Check* ask;
  Needs needs;
};

// In this order: a wrong clock or unit makes all that comes later look wrong, too.
constexpr std::array checks = {
    Question{check_copies, Needs::nothing},   Question{check_clock, Needs::time},
    Question{check_units, Needs::nothing},    Question{check_frame, Needs::nothing},
    Question{check_frame_steps, Needs::time}, Question{check_labels, Needs::nothing},
    Question{check_slips, Needs::time},       Question{check_holds, Needs::rest},
    Question{check_drive, Needs::time},       Question{check_rate, Needs::time},
    Question{check_releases, Needs::rest},    Question{check_paths, Needs::nothing},
    Question{check_loads, Needs::rest},       Question{check_jumps, Needs::time},
    Question{check_force_clock, Needs::time}, Question{check_force, Needs::time}};

bool is_met(Needs needs, const Trial& trial) {
  // A trial that begins in motion has no rest before it. There the plant swings as it did before,
  // and what leaves its place leaves it by itself.
  if (needs == Needs::rest && trial.window) return false;
  return needs == Needs::nothing || !trial.is_static;
}

}  // namespace

std::vector<Contradiction> contradictions(const Experiment& experiment) {
  std::vector<Contradiction> found;
  // One for all trials under the same gravity: it is built and settled, which no check should do
  // anew.
  std::list<std::pair<Vec3, std::optional<NominalPlant>>> plants;
  const auto plant_under = [&](const Vec3& gravity) {
    auto known = std::ranges::find(plants, gravity, [](const auto& one) { return one.first; });
    if (known == plants.end())
      known = plants.emplace(plants.end(), gravity, NominalPlant::of(experiment, gravity));
    return known->second ? &*known->second : nullptr;
  };
  // Trial by trial: tables are written trial by trial, and one that is right is no excuse for
  // another.
  for (const Trial& trial : experiment.trials) {
    // Checks get the plant where it can be built, and those that do not need it run in any case.
    const TrialView view{experiment, trial, plant_under(trial.gravity)};
    for (std::size_t kind = 0; kind < checks.size(); ++kind)
      if (!is_met(checks[kind].needs, trial)) {
        continue;
      } else if (auto one = checks[kind].ask(view)) {
        found.push_back(
            // The number of the check stands for the kind of mistake, so that one mistake in ten
            // trials can be told once.
            {trial.name, trial.folder / one->file, static_cast<int>(kind), std::move(one->what)});
        // One a trial: what follows it is mostly its consequence.
        break;
      }
  }
  return found;
}

void add_to(Diagnostics& diagnostics, const Experiment& experiment,
            const std::vector<Contradiction>& found) {
  for (const Contradiction& one : found)
    // Without a line: what contradicts is a table as a whole, or two of them.
    diagnostics.error({(experiment.folder / one.file).string(), 0, 0}, one.what);
}

// A wrong unit is in every table of an experiment. Twenty equal sentences would hide the one that
// is another mistake.
std::string sentence(const std::vector<Contradiction>& found) {
  std::string text;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto is_same = [&](const Contradiction& other) { return other.kind == found[i].kind; };
    // One mistake in many trials is one sentence.
    if (std::ranges::any_of(std::span(found).first(i), is_same)) continue;
    text += (text.empty() ? "" : "; ") + found[i].sentence();
    std::string others;
    for (const Contradiction& other : std::span(found).subspan(i + 1))
      if (is_same(other)) others += (others.empty() ? " (and so " : ", ") + other.file.string();
    text += others.empty() ? "" : others + ")";
  }
  return text;
}

}  // namespace pedicel::discrepancy
