#include "plugins/discrepancy/select/search_simulators.h"

namespace pedicel::discrepancy {

void SearchSimulators::anchor_at(const FitSummary& model) {
  // First, so that both never stand in memory together.
  drop_coarse();
  coarse_ = std::make_unique<CoarseModel>(setup_, model);
  coarse_workers_ = coarse_->workers();
}

void SearchSimulators::renew_fine() {
  drop_fine();
  for (int i = 0; i < setup_.threads(); ++i) {
    fine_.push_back(
        std::make_unique<Simulator>(setup_.experiment(), setup_.numerics(), 1, setup_.stop()));
    fine_workers_.emplace_back(*fine_.back(), setup_.data(), setup_.corrections());
  }
}

void SearchSimulators::drop() {
  drop_coarse();
  drop_fine();
}

std::vector<Direction> SearchSimulators::directions_of(const FitSummary& model,
                                                       const std::vector<Cause>& causes,
                                                       const std::vector<Direction>& known) {
  Evaluator evaluator = coarse_->evaluator();
  return discrepancy::directions_of(evaluator, model, causes, setup_.options(), known);
}

long SearchSimulators::simulations() const {
  long all = simulations_ + (coarse_ ? coarse_->simulations() : 0);
  for (const auto& simulator : fine_) all += simulator->simulations();
  return all;
}

void SearchSimulators::drop_coarse() {
  // What was simulated counts, whoever did it.
  if (coarse_) simulations_ += coarse_->simulations();
  coarse_workers_.clear();
  coarse_.reset();
}

void SearchSimulators::drop_fine() {
  for (const auto& simulator : fine_) simulations_ += simulator->simulations();
  fine_workers_.clear();
  fine_.clear();
}

}  // namespace pedicel::discrepancy
