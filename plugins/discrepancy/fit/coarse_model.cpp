#include "plugins/discrepancy/fit/coarse_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "plugins/discrepancy/fit/shift_fit.h"

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
  // Measured against what the anchor leaves: a search far from the data tells large effects apart,
  // and needs no better simulator for that.
  const double left = std::sqrt(2.0 * anchor.cost / std::max(1, setup.samples()));
  const double allowed = std::max(accuracy.coarse_error, accuracy.coarse_share * left);
  const Numerics fine = setup.numerics();
  // On a coarser mesh a weak stretch is shorter than a segment, and its place cannot be found. A
  // fine mesh that is coarser than this itself stays as it is.
  const double coarsest =
      std::max(fine.distance, accuracy.coarsest_mesh * setup.experiment().plant().distance);
  // The cheapest first. The last one is the fine simulator itself, which has no error against
  // itself, so that there is always one that does.
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
  // On top of what the fine simulator is corrected by. So the coarse one aims at what an exact one
  // would predict, and not at the fine one's errors.
  corrections_ = fine ? *fine : Corrections{};
  // Both are run as the fits run them, with the shift of the model's share of the mesh, so that the
  // difference is zero at the model itself.
  const Shift there = corrections_.shift(model.hypothesis.mesh_share());
  const Predictions wanted = run_shifted(setup_.simulator(), model.hypothesis, {{there}}).front();
  const ShiftFit shifts(*simulator_, setup_.data(), model.hypothesis, there, setup_.options());
  const Shift more = shifts.stands_for(wanted, shifts.now());
  Shift shifted = there;
  shifted.add(1.0, more);
  const Predictions now = run_shifted(*simulator_, model.hypothesis, {{shifted}}).front();
  // First what another modulus stands for: that follows the model as it changes. Only the rest is a
  // constant, right at the anchor alone.
  corrections_.own.shift.add(1.0, more);
  add_difference(corrections_.own.rest, 1.0, wanted, now);
  // Whoever adds corrections asks all three parts for every trial; empty ones have to be there.
  if (!fine)
    for (Correction* none : {&corrections_.first, &corrections_.second})
      add_difference(none->rest, 0.0, wanted, now);
  // Of the rest alone, since the shift goes along with the model. It is the rest that grows wrong
  // away from the anchor.
  error_ = rms(shifts.change(wanted, now), setup_.samples());
}

Evaluator CoarseModel::evaluator() {
  return Evaluator(*simulator_, setup_.data(), &corrections_);
}

std::vector<Evaluator> CoarseModel::workers() {
  std::vector<Evaluator> all;
  // Candidates are fitted side by side, each on a thread of its own: a fit is a chain of few small
  // simulations, which cannot fill all threads by itself.
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
