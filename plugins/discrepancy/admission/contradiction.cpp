#include "pedicel/discrepancy/admission/contradiction.h"

#include <algorithm>
#include <array>
#include <span>

#include "pedicel/discrepancy/admission/contradiction_checks.h"

namespace pedicel::discrepancy {

namespace {

// In this order: a wrong clock or unit makes all that comes later look wrong, too.
constexpr std::array checks = {check_copies,      check_clock,       check_units, check_frame,
                               check_frame_steps, check_labels,      check_holds, check_drive,
                               check_rate,        check_releases,    check_paths, check_loads,
                               check_jumps,       check_force_clock, check_force};

}  // namespace

std::vector<Contradiction> contradictions(const Experiment& experiment) {
  std::vector<Contradiction> found;
  const std::optional<Layout> layout = Layout::of(experiment);
  for (const Trial& trial : experiment.trials) {
    const TrialView view{experiment, trial, layout ? &*layout : nullptr};
    for (std::size_t kind = 0; kind < checks.size(); ++kind)
      if (auto one = checks[kind](view)) {
        found.push_back(
            {trial.name, trial.folder / one->file, static_cast<int>(kind), std::move(one->what)});
        break;
      }
  }
  return found;
}

void add_to(Diagnostics& diagnostics, const Experiment& experiment,
            const std::vector<Contradiction>& found) {
  for (const Contradiction& one : found)
    diagnostics.error({(experiment.folder / one.file).string(), 0, 0}, one.what);
}

std::string sentence(const std::vector<Contradiction>& found) {
  std::string text;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto is_same = [&](const Contradiction& other) { return other.kind == found[i].kind; };
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
