#include "app/steer/state_arrays.h"

#include <algorithm>
#include <utility>

namespace pedicel::app {

StateArrays::StateArrays(RowLayout layout, int worlds)
    : layout_(std::move(layout)), worlds_(worlds) {
  for (const Quantity& one : simulation::quantities()) {
    Array& array = all_.emplace_back();
    if (one.name.empty()) continue;
    const auto size = static_cast<std::size_t>(worlds) *
                      static_cast<std::size_t>(layout_.rows(one.rows)) *
                      static_cast<std::size_t>(one.columns);
    // Never empty, so that a view has a place.
    if (one.flag)
      array.flags.resize(std::max<std::size_t>(size, 1));
    else
      array.numbers.resize(std::max<std::size_t>(size, 1));
  }
}

bool StateArrays::want(std::size_t quantity) {
  return !std::exchange(all_[quantity].wanted, true);
}

void StateArrays::fill(const simulation::Simulation& simulation, int world) {
  for (std::size_t q = 0; q < all_.size(); ++q) {
    if (!all_[q].wanted) continue;
    const Quantity& one = simulation::quantities()[q];
    const auto first = static_cast<std::ptrdiff_t>(world) * layout_.rows(one.rows);
    each_row(simulation, layout_, one.rows, [&](const simulation::Row& row, int number) {
      if (!one.flag) return one.read(row, numbers(q) + (first + number) * one.columns);
      double flag = 0.0;
      one.read(row, &flag);
      flags(q)[first + number] = flag != 0.0;
    });
  }
}

}  // namespace pedicel::app
