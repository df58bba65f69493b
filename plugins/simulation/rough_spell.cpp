#include "plugins/simulation/rough_spell.h"

#include <algorithm>

#include "engine/io/csv.h"
#include "plugins/simulation/plants/folded_stem.h"

namespace pedicel::simulation {

namespace {

// Half a second at the usual step: a knock is over by then.
constexpr int worth_saying = 100;  // steps
// A stem that snaps through a fold is on the ridge for some steps only.
constexpr int folds_after = 20;  // steps

// "gantry/gripper": what pushes plants most; empty where nothing does.
std::string strongest(const Simulation& simulation) {
  const std::vector<coupling::ContactSum>& sums = simulation.plant_step().contacts().colliders();
  const auto most = std::ranges::max_element(sums, {}, &coupling::ContactSum::normal);
  if (most == sums.end() || most->normal == 0.0) return "";
  return simulation.colliders().collider(static_cast<int>(most - sums.begin())).name;
}

}  // namespace

void RoughSpell::look(const Simulation& simulation, const world::WorldReport& report) {
  if (!(report.errors & world::plant_not_converged)) {
    row_ = 0;
    return;
  }
  if (row_++ == 0) from_ = report.time;
  if (row_ >= folds_after) look_for_folds(simulation);
  // Only the longest is told, and as it is while it lasts: who presses may be gone after it.
  if (row_ <= std::max(longest_, worth_saying)) return;
  longest_ = row_;
  const std::string presser = strongest(simulation);
  text_ = " steps in a row from " + io::format_number(from_, 4) + " s: " + report.culprit +
          (presser.empty() ? "" : ", pressed by " + presser);
}

void RoughSpell::look_for_folds(const Simulation& simulation) {
  for (int p = 0; p < simulation.rods().size() && folded_.empty(); ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    const int element = folded_element(model, simulation.rods().state(p));
    if (element < 0) continue;
    folded_ = "warning: at " + io::format_number(from_, 4) + " s " +
              model.organs[model.elements[element].organ] + " was " + folded_text;
  }
}

std::string RoughSpell::warning() const {
  if (!folded_.empty()) return folded_;
  if (longest_ == 0) return "";
  return "warning: no equilibrium in " + std::to_string(longest_) + text_ +
         ": what it does and bears there is inexact";
}

}  // namespace pedicel::simulation
