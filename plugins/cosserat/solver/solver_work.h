#pragma once

#include <memory>
#include <vector>

#include "plugins/cosserat/solver/canopy.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::cosserat {

/// What a system solves its plants with. It is no part of rod_system.h, so that who holds plants
/// need not see the solver's lanes.
struct RodSystem::Work {
  /// Plants that are solved together: as many as stay in a core's cache from one phase of a step to
  /// the next; one plant that is larger than a thread's share goes with all the others, and threads
  /// then share the phases.
  struct Bed {
    std::unique_ptr<DirectSolver> solver;
    int first = 0;   // its first plant
    int thread = 0;  // that steps it, where there are several beds
    std::vector<DirectSolver::PlantStep> steps;

    /// `plants`: all of the system. `pool`: null where it is one of several beds, which a thread
    /// steps alone. `next`: what that thread reads afterwards; null: nothing else.
    void step(std::vector<Plant>& plants, double dt, const Vec3& gravity, ThreadPool* pool,
              FetchAhead* next);
  };

  /// What the solver is handed of a plant; it points into it.
  static DirectSolver::PlantStep step_of(Plant& plant);
  void make_beds(RodSystem& system);
  void step_canopy(RodSystem& system, double dt, const Vec3& gravity);
  FetchAhead* what_follows(const std::vector<Plant>& plants, const Bed& bed);

  std::vector<Bed> beds;           // direct solver; made by the first step after add_plant()
  std::unique_ptr<Canopy> canopy;  // where plants touch or hold each other; made by a step
  std::vector<DirectSolver::PlantStep> steps;  // of the canopy
  struct alignas(64) Ahead {
    FetchAhead next_bed;
  };
  std::vector<Ahead> ahead;  // by thread
};

}  // namespace pedicel::cosserat
