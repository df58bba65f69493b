#pragma once

#include <array>

#include "plugins/cosserat/solver/attachments.h"
#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/rod_rows.h"

namespace pedicel::cosserat::cases {

/// The incremental potential of one plant over one step, without contact, as DirectSolver puts it
/// together, at any state.
class StepPotential {
 public:
  explicit StepPotential(const RodModel& model)
      : rows_(std::array{&model}, 1, true), extras_(model.size()) {}

  /// The step starts from `start`, which must outlive it. `extended`: the model again, where it has
  /// extensions.
  void prepare(const RodState& start, const StepInput& input, const RodHistory* history,
               const RodModel* extended = nullptr) {
    rows_.store.gravity = input.gravity;
    rows_.states.set_scheme(0, input.dt, history == nullptr ? 0.0 : input.dt,
                            std::array{own_clamp(start)});
    if (extended) rows_.extensions.begin_step(0, *extended, start.time, input.dt, false);
    if (history) rows_.states.set_history(0, *history);
    rows_.states.prepare(alone_, std::array{&start});
    attachments_.prepare(start, input.loads, {});
  }

  /// Gradient and Hessian into `system`; returns the potential, J.
  double linearise(const RodModel& model, const RodState& state, BlockSystem& system) {
    rows_.states.read_iterate(0, state);
    rows_.elimination.eliminate(alone_);
    rows_.elimination.copy_blocks(0, system);
    extras_.clear();
    const double energy = attachments_.linearise(model, state, extras_);
    for (const DiagonalBlocks::Entry& entry : extras_.entries()) {
      system.diagonal(entry.element) += entry.diagonal;
      system.right_side(entry.element) += entry.right_side;
    }
    for (std::size_t w = 0; w < model.welds.size(); ++w)
      system.weld(static_cast<int>(w)) = weld_coupling(state, model.welds[w]);
    return energy + rows_.search.energy_before(0);
  }

  double potential(const RodModel& model, const RodState& state) {
    rows_.states.read_iterate(0, state);
    rows_.search.measure(alone_);
    return rows_.search.energy(0) + attachments_.potential(model, state);
  }

 private:
  ThreadPool alone_{1};
  RodRows rows_;
  Attachments attachments_;
  DiagonalBlocks extras_;
};

}  // namespace pedicel::cosserat::cases
