#include "pedicel/app/run/rough_spell.h"

#include <algorithm>

#include "pedicel/io/csv.h"

namespace pedicel::app {

namespace {

// Half a second at the usual step: a knock is over by then.
constexpr int worth_saying = 100;  // steps

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
  // Only the longest is told, and as it is while it lasts: who presses may be gone after it.
  if (row_ <= std::max(longest_, worth_saying)) return;
  longest_ = row_;
  const std::string presser = strongest(simulation);
  text_ = " steps in a row from " + io::format_number(from_, 4) + " s: " + report.culprit +
          (presser.empty() ? "" : ", pressed by " + presser);
}

std::string RoughSpell::warning() const {
  if (longest_ == 0) return "";
  return "warning: no equilibrium in " + std::to_string(longest_) + text_ +
         ": what it does and bears there is inexact";
}

}  // namespace pedicel::app
