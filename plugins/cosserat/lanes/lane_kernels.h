#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plugins/cosserat/lanes/lanes.h"

namespace pedicel::cosserat {

/// The inner loops of the direct solver, eight elements at a time, on the widest vectors that the
/// processor has (Google Highway chooses at run time). All of them work lane by lane: what an
/// element gets does not depend on its neighbours, so neither does it on how plants are packed.
/// Different instruction sets agree to rounding (fused or separate multiply-adds).

/// Sets the terms of the step that starts from `start` and `rate`, with `previous` and
/// `previous_rate` one step before, and Newton's first guess into `iterate`: the motion continued.
/// Sets `turn`: how far that turns an element, at most (2 sin of half the angle).
void prepare(const RowArrays& rows, Pack& pack);

/// Gradient and Hessian at `iterate`, and the elimination of every element into its parent, from
/// the tips to the first element. Sets `energy_before`, `healthy` and `branch`.
void linearise_and_eliminate(const RowArrays& rows, Pack& pack);

/// The same of a stem's first piece, the other way round: every element into its child, from the
/// clamp to the last one, where the rest of the plant meets them (a twisted factorisation: Meurant
/// 1992, SIAM J. Matrix Anal. Appl. 13). So two threads can work on a stem, one from each end. Sets
/// `energy_before`, `healthy`, and `branch` to the block of the last row without what starts there.
void eliminate_from_clamp(const RowArrays& rows, Pack& pack);

/// The change of such a pack's last row, when all has been eliminated into it.
void solve_last(const RowArrays& rows, Pack& pack);

/// From there to everyone's in the pack. Sets `turn`, `shift`, `change`.
void substitute_to_clamp(const RowArrays& rows, Pack& pack);

/// As linearise_and_eliminate(), of a pack of loop parts: each into what carries it, in the order
/// of its LoopShape.
void eliminate_loops(const RowArrays& rows, Pack& pack);

/// From the changes of what carries them to everyone's. Sets `turn`, `shift`, `change`.
void substitute_loops(const RowArrays& rows, Pack& pack);

/// Gradient and Hessian alone, left in `blocks`. Sets `energy_before`.
void linearise(const RowArrays& rows, Pack& pack);

/// From the parents' changes in the pack's first row to everyone's. Sets `turn`, `shift`, `change`.
void substitute(const RowArrays& rows, Pack& pack);

/// `turn`, `shift`, `change` of a solution that is in `factor` already.
void measure_change(const RowArrays& rows, Pack& pack);

/// iterate = base moved by `share` of the change, in the rows from `first` to before `end`; `keep`
/// first makes base the iterate, which ends the use of the factors (FactorRow). The row before
/// `first` must hold the parents' new poses. `measured`: sets `energy` to the potential there, as
/// evaluate() does, which takes longer than the move itself.
void move(const RowArrays& rows, Pack& pack, int first, int end, bool keep, bool measured);

/// The potential at `iterate`, J.
void evaluate(const RowArrays& rows, const Pack& pack, Lanes& energy);

/// Velocities that the scheme gives to the end of the step, into `rate` (strains are left).
void finish(const RowArrays& rows, const Pack& pack, RateRow* end);

/// Instruction sets that the kernels are compiled for and this processor has, best first.
std::vector<std::string> available_instruction_sets();
/// Uses one of them from now on (tests, benchmarks); "" is the best.
void use_instruction_set(const std::string& name);

}  // namespace pedicel::cosserat
