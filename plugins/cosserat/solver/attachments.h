#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/lanes/diagonal_blocks.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/rod_solver.h"
#include "plugins/cosserat/solver/strings.h"

namespace pedicel::cosserat {

/// Loads, ties, strands, supports and welds of one plant as terms of the incremental potential of a
/// step.
class Attachments {
 public:
  /// `welds`: whether they are among them; else the rows have them.
  explicit Attachments(bool welds = true) : welds_(welds) {}

  /// The step starts at `start`: there loads have done no work.
  void prepare(const RodState& start, std::span<const Load> loads, std::span<const Tie> ties);

  /// Adds gradient (negative, as right side) and Hessian at `state`, without what welds and strands
  /// couple;
  /// returns the potential (J). `state` becomes the one from which dead moments count their work.
  double linearise(const RodModel& model, const RodState& state, DiagonalBlocks& blocks);

  /// The potential at `state`.
  double potential(const RodModel& model, const RodState& state) const;

 private:
  void refer_moments_to(const RodState& state);
  double sum(const RodModel& model, const RodState& state, DiagonalBlocks* blocks) const;
  double load(const RodState& state, int index, DiagonalBlocks* blocks) const;
  double tie(const RodState& state, const Tie& tie, DiagonalBlocks* blocks) const;
  double strand(const RodState& state, const Strand& strand, DiagonalBlocks* blocks) const;
  double support(const RodState& state, const Support& support, DiagonalBlocks* blocks) const;
  double weld(const RodState& state, const Weld& weld, DiagonalBlocks* blocks) const;

  bool welds_ = true;
  const RodState* start_ = nullptr;
  std::span<const Load> loads_;
  std::span<const Tie> ties_;
  std::vector<Quat> moment_reference_;  // E to W, one a load: where its moment has done no work
};

/// What a weld couples: rows of its element b, columns of its a.
Mat6 weld_coupling(const RodState& state, const Weld& weld);
/// Likewise of a strand.
Mat6 strand_coupling(const RodState& state, const Strand& strand);

}  // namespace pedicel::cosserat
