#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/solver/row_elimination.h"
#include "plugins/cosserat/solver/row_states.h"

namespace pedicel::cosserat {

/// The iterate, moved along Newton's change, and the incremental potential (without loads,
/// supports, welds and contact) where it goes: what a line search needs.
class RowSearch {
 public:
  RowSearch(RowStore& store, const RowStates& states, RowElimination& elimination)
      : store_(store),
        states_(states),
        elimination_(elimination),
        shares_(store.clamps.size(), 0.0) {}

  /// Sets energy_before() to what the step's start would have, with the clamps where they end, and
  /// energy() to what the first guess has. Writes the iterates as RowStates::write_iterate() does.
  void compare_start(ThreadPool& pool, std::span<RodState* const> states);

  /// Moves the iterate from where the line search began by `share` of the change, by plant.
  void set_share(int plant, double share);
  /// `keep` first makes the iterate that beginning; energy() follows where it is `measured`. Writes
  /// the iterates as RowStates::write_iterate() does.
  void move(ThreadPool& pool, bool keep, bool measured, std::span<RodState* const> states);
  /// Sets energy() where move() did not.
  void measure(ThreadPool& pool);
  /// RowElimination's eliminate() and substitute(), and move(true, measured) in one go, where
  /// nothing has to happen between them.
  void solve_and_move(ThreadPool& pool, bool measured, std::span<RodState* const> states);

  /// Asks for all that an iteration led to, so that its readers need not wait for it one by one.
  void fetch_results() const;
  /// J, where the last move() that was measured led, or of the last measure().
  double energy(int plant) const { return sum(plant, &Pack::energy); }
  /// J, where Newton's system was made.
  double energy_before(int plant) const { return sum(plant, &Pack::energy_before); }

 private:
  void move_task(const RowArrays& rows, int task, bool keep, bool measured,
                 std::span<RodState* const> states);
  double sum(int plant, const Lanes Pack::*energy) const;

  RowStore& store_;
  const RowStates& states_;
  RowElimination& elimination_;
  std::vector<double> shares_;  // 1, by plant
};

}  // namespace pedicel::cosserat
