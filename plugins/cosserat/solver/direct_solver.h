#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/thread_pool.h"
#include "plugins/cosserat/solver/attachments.h"
#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/contact_terms.h"
#include "plugins/cosserat/solver/iteration_control.h"
#include "plugins/cosserat/solver/rod_rows.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// Newton's method on the incremental potential of a step, with a positive definite Hessian, the
/// O(n) block elimination of the tree and a backtracking line search (plugins/cosserat/README.md).
///
/// All plants take their iterations together, because equal branches and equal plants are computed
/// side by side (lanes.h); each has its own line search and stops by itself. What a plant does
/// depends neither on the others nor on the number of threads, to the bit.
class DirectSolver : public RodSolver {
 public:
  /// One plant.
  DirectSolver(const RodSettings& settings, const RodModel& model);
  /// Several; `threads` is how many will step them.
  /// Solvers that never step at once may share `scratch`.
  DirectSolver(const RodSettings& settings, std::span<const RodModel* const> models, int threads,
               std::shared_ptr<RowScratch> scratch = nullptr);

  /// One plant of several. The model is read again where `model_changed` is set; where
  /// `state_changed` is not, the state is what the step before left in it.
  struct PlantStep {
    const RodModel* model = nullptr;
    RodState* state = nullptr;
    std::span<const Load> loads;
    std::span<ContactSource* const> contacts;
    bool model_changed = true, state_changed = true;
    StepReport report;  ///< set by the step
    /// Of each of its trees; empty: it is one tree, clamped at its state's root.
    std::span<const Clamp> clamps = {};
    std::span<const Tie> ties = {};
    std::span<const Vec3> air = {};  ///< as RowExtensions::begin_step() takes it
  };
  /// Steps all the plants that it was made for, in that order.
  void step(std::span<PlantStep> plants, double dt, const Vec3& gravity, ThreadPool& pool);
  /// The same in the caller's thread alone, which fetches meanwhile what it works on next.
  void step(std::span<PlantStep> plants, double dt, const Vec3& gravity,
            FetchAhead* ahead = nullptr) {
    rows_.store.fetch_along(ahead);
    step(plants, dt, gravity, alone_);
  }
  void add_to(FetchAhead& ahead) const { rows_.store.add_to(ahead); }
  StepReport step(const RodModel& model, RodState& state, const StepInput& input) override;

  const std::vector<ContactForce>& contact_forces() const override { return contact_forces(0); }
  const std::vector<ContactForce>& contact_forces(int plant) const {
    return plants_[plant].contacts.forces();
  }
  void change_settings(const RodSettings& settings) override { settings_ = settings; }
  void reset() override { reset(0); }
  void reset(int plant);

  /// Whether steps look for settled shapes from now on: joints without dashpots and friction
  /// sliders, the mean wind, stiffness at the state's own time; drag follows the segments that turn
  /// by `axis_share` of the way an iteration. settle() does so.
  void set_settling(bool settling, double axis_share = 1.0) {
    settling_ = settling;
    rows_.store.axis_share = axis_share;
  }

 private:
  struct Plant {
    /// `by_blocks`: a block system solves it.
    Plant(const RodModel& model, bool by_blocks);

    Attachments attachments;
    ContactTerms contacts;
    DiagonalBlocks extras;
    std::unique_ptr<BlockSystem> loops;  // where its parts with loops are large
    bool touched = false;                // by loads, supports, welds or contact sources
    RodState iterate;                    // where touched
    bool iterate_is_here = false;        // where the line search ended
    bool contacts_are_here = false;      // found there, too
    bool presses = false;                // a contact did, in this iteration
    bool has_history = false;
    double extra_energy = 0.0;  // J, of `touched`, where the line search began
    double pressed = 0.0;       // J, of the known contacts where a search ended
    IterationControl control;
    std::unique_ptr<DirectSolver> substepper;  // once a step was taken in substeps
    bool substepped = false;                   // this step was taken so
    bool stands_in_rows = false;               // where it ended is where the rows have it

    Pressing pressing() const;
  };

  void begin(std::span<PlantStep> steps, double dt, const Vec3& gravity, ThreadPool& pool);
  template <class Wanted, class Task>
  void for_each_plant(std::span<PlantStep> steps, ThreadPool& pool, const Wanted& wanted,
                      const Task& task);
  void lend(ThreadPool* pool, int index, const PlantStep& step);
  void begin_memory(int index, const RodModel& model, RodState& state) const;
  void choose_start(std::span<PlantStep> steps, ThreadPool& pool);
  void solve(std::span<PlantStep> steps, double dt, ThreadPool& pool);
  void linearise_touched(std::span<PlantStep> steps, double dt, ThreadPool& pool);
  void hand_over_blocks();
  void find_contacts(int index, const PlantStep& step, double dt);
  bool follow_contacts(int index, const PlantStep& step);
  void solve_loops(int index, const RodModel& model);
  void search(std::span<PlantStep> steps, bool measured, ThreadPool& pool);
  void start_search(int index, const RodModel& model, StepReport& report);
  void try_share(int index, const RodModel& model, StepReport& report);
  void validate_contacts(std::span<PlantStep> steps, double dt, ThreadPool& pool);
  void take_in_substeps(int index, PlantStep& step, double dt, const Vec3& gravity);
  void end(std::span<PlantStep> steps, double dt, ThreadPool& pool);
  int size() const { return static_cast<int>(plants_.size()); }

  RodSettings settings_;
  RodRows rows_;
  std::vector<Plant> plants_;
  // By plant.
  std::vector<RodState*> states_, iterates_;  // nullptr where not to be written
  std::vector<char> working_, searching_;     // Newton, its line search: not done yet
  std::vector<char> unchanged_;               // begins where the rows have it
  bool any_loops_ = false;
  bool only_contacts_ = false;  // the rows have no other blocks
  bool settling_ = false;
  bool is_substepper_ = false;        // takes the substeps of another one
  std::vector<ContactForce> forces_;  // of the substeps
  ThreadPool alone_{1};
};

// task(p) for the plants that are wanted. A single one may use the threads for itself, with the
// sources that touch it.
template <class Wanted, class Task>
void DirectSolver::for_each_plant(std::span<PlantStep> steps, ThreadPool& pool,
                                  const Wanted& wanted, const Task& task) {
  int count = 0, last = 0;
  for (int p = 0; p < size(); ++p) {
    if (!wanted(p)) continue;
    ++count;
    last = p;
  }
  if (count > 1) {
    pool.for_each(size(), [&](int p) {
      if (wanted(p)) task(p);
    });
  } else if (count == 1) {
    lend(&pool, last, steps[last]);
    task(last);
    lend(nullptr, last, steps[last]);
  }
}

/// Finds the static equilibrium that the state settles into under gravity and loads (Newton with
/// the inertia taken out, damped by nothing: many iterations of one huge backward Euler step).
/// Extensions are as they are at a trial's beginning: relaxation and creep unrelaxed, friction
/// sliders at zero, the mean wind; what yields does so. Then the joints' memory starts there
/// (start_memory()). Velocities end at zero. Returns the report of the last iteration;
/// `not_converged` where `iterations` did not do.
StepReport settle(const RodModel& model, RodState& state, const Vec3& gravity,
                  std::span<const Load> loads = {}, int iterations = 500);

}  // namespace pedicel::cosserat
