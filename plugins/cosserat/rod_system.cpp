#include "cosserat/rod_system.h"

#include "cosserat/direct_solver.h"

namespace pedicel::cosserat {

RodSystem::RodSystem(const RodSettings& settings, int threads)
    : settings_(settings), pool_(threads) {}

int RodSystem::add_plant(RodModel model) {
  Plant plant;
  plant.state = drawn_state(model);
  plant.solver = make_solver(settings_, model);
  plant.model = std::move(model);
  plants_.push_back(std::move(plant));
  return size() - 1;
}

void RodSystem::add_contact_source(int plant, std::unique_ptr<ContactSource> source) {
  plants_[plant].source_pointers.push_back(source.get());
  plants_[plant].sources.push_back(std::move(source));
}

void RodSystem::step(double dt, const Vec3& gravity) {
  pool_.for_each(size(), [&](int i) { step_plant(plants_[i], dt, gravity); });
}

void RodSystem::step_plant(Plant& plant, double dt, const Vec3& gravity) {
  const StepInput input{dt, gravity, plant.loads, plant.source_pointers};
  plant.report = plant.solver->step(plant.model, plant.state, input);
  plant.detached.clear();
  detach(plant.model, plant.state, plant.detached);
}

const std::vector<ContactForce>& RodSystem::contact_forces(int plant) const {
  return plants_[plant].solver->contact_forces();
}

void RodSystem::set_state(int plant, const RodState& state) {
  plants_[plant].state = state;
  plants_[plant].state.previous_dt = 0.0;
  plants_[plant].state.previous_root = state.root;
  plants_[plant].solver->reset();
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
