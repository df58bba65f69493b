#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::cosserat {

/// Systems whose steps are made at once, such as variants of one scene: their plants are solved as
/// those of one system, so that equal plants share the solver's lanes. Each system still takes off
/// what breaks, and reports, by itself. For the direct solver, without strings and without plants
/// that touch each other.
///
/// Each system belongs to a world with a step of its own. step() starts the first one; where that
/// comes to its plants it waits for the step of the second, and so on; the last one's call solves
/// all of them.
class JoinedSystems : public RodSystem::Joint {
 public:
  /// `settings`: of all. `systems` must outlive it, and step nowhere else while it lives.
  JoinedSystems(const RodSettings& settings, std::vector<RodSystem*> systems);
  ~JoinedSystems() override;

  /// `begin(i)` makes the step of the i-th system's world, RodSystem::step() within it.
  void step(const std::function<void(int)>& begin);

  void solve(const RodSystem& system, double dt, const Vec3& gravity) override;
  const std::vector<ContactForce>& contact_forces(const RodSystem& system,
                                                  int plant) const override;
  void reset(const RodSystem& system, int plant) override;

 private:
  int first_of(const RodSystem& system) const;

  RodSettings settings_;
  std::vector<RodSystem*> systems_;
  std::vector<int> first_;                // plant of each system among all
  std::unique_ptr<DirectSolver> solver_;  // made by the first step
  std::vector<DirectSolver::PlantStep> steps_;
  const std::function<void(int)>* begin_ = nullptr;  // while a step is being made
  int at_ = 0;                                       // system that steps
};

}  // namespace pedicel::cosserat
