#include "plugins/cosserat/solver/joined_systems.h"

#include "engine/core/check.h"
#include "plugins/cosserat/solver/solver_work.h"

namespace pedicel::cosserat {

JoinedSystems::JoinedSystems(const RodSettings& settings, std::vector<RodSystem*> systems)
    : settings_(settings), systems_(std::move(systems)) {
  int plants = 0;
  for (RodSystem* system : systems_) {
    if (system->solver() != SolverKind::direct || system->touching_ || !system->strings_.empty())
      throw UsageError(
          "JoinedSystems: a system with another solver, strings or plants that touch each other, "
          "must have none");
    system->joint_ = this;
    first_.push_back(plants);
    plants += system->size();
  }
  steps_.resize(static_cast<std::size_t>(plants));
}

JoinedSystems::~JoinedSystems() {
  for (RodSystem* system : systems_) system->joint_ = nullptr;
}

void JoinedSystems::step(const std::function<void(int)>& begin) {
  begin_ = &begin;
  at_ = 0;
  begin(0);
}

void JoinedSystems::solve(const RodSystem&, double dt, const Vec3& gravity) {
  if (++at_ < static_cast<int>(systems_.size())) {
    // Within this call all others make their steps up to here, and the last one solves.
    (*begin_)(at_);
    return;
  }
  if (!solver_) {
    std::vector<const RodModel*> models;
    for (RodSystem* system : systems_)
      for (RodSystem::Plant& plant : system->plants_) {
        plant.model_changed = plant.state_changed = true;
        models.push_back(&plant.model);
      }
    solver_ = std::make_unique<DirectSolver>(settings_, models, 1, nullptr);
  }
  std::size_t next = 0;
  for (RodSystem* system : systems_)
    for (RodSystem::Plant& plant : system->plants_)
      steps_[next++] = RodSystem::Work::step_of(plant);
  solver_->step(steps_, dt, gravity, static_cast<FetchAhead*>(nullptr));
  next = 0;
  for (RodSystem* system : systems_)
    for (RodSystem::Plant& plant : system->plants_) plant.report = steps_[next++].report;
}

int JoinedSystems::first_of(const RodSystem& system) const {
  for (std::size_t i = 0; i < systems_.size(); ++i)
    if (systems_[i] == &system) return first_[i];
  throw UsageError("JoinedSystems: a system that is not joined");
}

const std::vector<ContactForce>& JoinedSystems::contact_forces(const RodSystem& system,
                                                               int plant) const {
  static const std::vector<ContactForce> none;
  return solver_ ? solver_->contact_forces(first_of(system) + plant) : none;
}

void JoinedSystems::reset(const RodSystem& system, int plant) {
  if (solver_) solver_->reset(first_of(system) + plant);
}

}  // namespace pedicel::cosserat
