#include "cosserat/rod_system.h"

namespace pedicel::cosserat {

RodSystem::RodSystem(const RodSettings& settings, int threads)
    : settings_(settings), pool_(threads) {}

int RodSystem::add_plant(RodModel model) {
  Plant plant;
  plant.state = drawn_state(model);
  if (settings_.solver == SolverKind::position_based) plant.solver = make_solver(settings_, model);
  plant.model = std::move(model);
  plants_.push_back(std::move(plant));
  direct_.reset();
  return size() - 1;
}

void RodSystem::add_contact_source(int plant, std::unique_ptr<ContactSource> source) {
  plants_[plant].source_pointers.push_back(source.get());
  plants_[plant].sources.push_back(std::move(source));
}

void RodSystem::step(double dt, const Vec3& gravity) {
  if (settings_.solver == SolverKind::direct) {
    step_directly(dt, gravity);
  } else {
    pool_.for_each(size(), [&](int i) {
      Plant& plant = plants_[i];
      plant.report = plant.solver->step(plant.model, plant.state,
                                        {dt, gravity, plant.loads, plant.source_pointers});
    });
  }
  for (Plant& plant : plants_) {
    plant.detached.clear();
    detach(plant.model, plant.state, plant.detached);
    plant.model_changed = !plant.detached.empty();
  }
}

void RodSystem::step_directly(double dt, const Vec3& gravity) {
  const bool is_new = !direct_;
  if (is_new) {
    std::vector<const RodModel*> models;
    for (const Plant& plant : plants_) models.push_back(&plant.model);
    direct_ = std::make_unique<DirectSolver>(settings_, models, pool_.threads());
    steps_.resize(plants_.size());
  }
  for (int i = 0; i < size(); ++i) {
    Plant& plant = plants_[i];
    steps_[i] = {&plant.model,
                 &plant.state,
                 plant.loads,
                 plant.source_pointers,
                 is_new || plant.model_changed,
                 {}};
  }
  direct_->step(steps_, dt, gravity, pool_);
  for (int i = 0; i < size(); ++i) plants_[i].report = steps_[i].report;
}

const std::vector<ContactForce>& RodSystem::contact_forces(int plant) const {
  static const std::vector<ContactForce> none;
  if (plants_[plant].solver) return plants_[plant].solver->contact_forces();
  return direct_ ? direct_->contact_forces(plant) : none;
}

void RodSystem::set_state(int plant, const RodState& state) {
  plants_[plant].state = state;
  plants_[plant].state.previous_dt = 0.0;
  plants_[plant].state.previous_root = state.root;
  if (plants_[plant].solver) plants_[plant].solver->reset();
  if (direct_) direct_->reset(plant);
}

void RodSystem::add_to(StateHash& hash) const {
  for (const Plant& plant : plants_) {
    for (int e = 0; e < plant.state.size(); ++e) {
      hash.add(plant.state.position[e]);
      hash.add(plant.state.orientation[e]);
      hash.add(plant.state.velocity[e]);
      hash.add(plant.state.angular_velocity[e]);
      hash.add(static_cast<std::uint64_t>(plant.state.alive[e]));
    }
  }
}

}  // namespace pedicel::cosserat
