#include "pedicel/discrepancy/fit/coarse_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pedicel/discrepancy/fit/shift_fit.h"

namespace pedicel::discrepancy {

namespace {

double rms(const Eigen::VectorXd& whitened, int samples) {
  return whitened.norm() / std::sqrt(std::max(1.0, static_cast<double>(samples)));
}

}  // namespace

// What is carried along may be wrong by as much as a model changes: it is a small part of the
// noise, or of what is left anyway.
CoarseModel::CoarseModel(FitSetup& setup, const FitSummary& anchor) : setup_(setup) {
  const Accuracy& accuracy = setup.options().settings->accuracy;
  const double left = std::sqrt(2.0 * anchor.cost / std::max(1, setup.samples()));
  const double allowed = std::max(accuracy.coarse_error, accuracy.coarse_share * left);
  const Numerics fine = setup.numerics();
  const double coarsest =
      std::max(fine.distance, accuracy.coarsest_mesh * setup.experiment().plant.distance);
  constexpr std::array<std::array<double, 2>, 3> by_mesh_and_step{{{2, 2}, {1, 2}, {1, 1}}};
  for (const auto [mesh, step] : by_mesh_and_step) {
    const double distance = std::min(mesh * fine.distance, coarsest);
    Numerics coarse = fine;
    coarse.distance = distance;
    coarse.dt = step * fine.dt;
    anchor_at(anchor, coarse);
    if (error_ <= allowed) break;
  }
}

void CoarseModel::anchor_at(const FitSummary& model, const Numerics& numerics) {
  numerics_ = numerics;
  simulator_ =
      std::make_unique<Simulator>(setup_.experiment(), numerics, setup_.threads(), setup_.stop());
  const Corrections* fine = setup_.corrections();
  corrections_ = fine ? *fine : Corrections{};
  const Shift there = corrections_.shift(model.hypothesis.mesh_share());
  const Predictions wanted = run_shifted(setup_.simulator(), model.hypothesis, {{there}}).front();
  const ShiftFit shifts(*simulator_, setup_.data(), model.hypothesis, there, setup_.options());
  const Shift more = shifts.stands_for(wanted, shifts.now());
  Shift shifted = there;
  shifted.add(1.0, more);
  const Predictions now = run_shifted(*simulator_, model.hypothesis, {{shifted}}).front();
  corrections_.own.shift.add(1.0, more);
  add_difference(corrections_.own.rest, 1.0, wanted, now);
  if (!fine)
    for (Correction* none : {&corrections_.first, &corrections_.second})
      add_difference(none->rest, 0.0, wanted, now);
  error_ = rms(shifts.change(wanted, now), setup_.samples());
}

Evaluator CoarseModel::evaluator() {
  return Evaluator(*simulator_, setup_.data(), &corrections_);
}

std::vector<Evaluator> CoarseModel::workers() {
  std::vector<Evaluator> all;
  while (static_cast<int>(single_.size()) < setup_.threads())
    single_.push_back(
        std::make_unique<Simulator>(setup_.experiment(), numerics_, 1, setup_.stop()));
  for (const auto& simulator : single_) all.emplace_back(*simulator, setup_.data(), &corrections_);
  return all;
}

long CoarseModel::simulations() const {
  long sum = simulator_->simulations();
  for (const auto& simulator : single_) sum += simulator->simulations();
  return sum;
}

}  // namespace pedicel::discrepancy
