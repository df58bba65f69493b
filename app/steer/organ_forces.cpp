#include "app/steer/organ_forces.h"

#include <algorithm>

namespace pedicel::app {

void OrganForces::set(const std::string& organ, double at, const Vec3& force_W,
                      const Vec3& moment_W) {
  const simulation::PlaceOnPlant place =
      simulation::find_organ_place(simulation_.rods(), organ, at);
  const auto found = std::ranges::find_if(
      all_, [&](const One& one) { return one.organ == organ && one.at == at; });
  if (found != all_.end()) {
    found->force_W = force_W;
    found->moment_W = moment_W;
    return;
  }
  // A slot of the rods' loads for each place that ever was: the scene's own loads keep theirs.
  std::vector<cosserat::Load>& loads = simulation_.rods().loads(place.plant);
  all_.push_back({organ, at, place, loads.size(), force_W, moment_W});
  cosserat::Load load;
  load.element = place.element;
  load.back = place.back;
  loads.push_back(load);
}

void OrganForces::clear() {
  for (One& one : all_) one.force_W = one.moment_W = Vec3::Zero();
}

void OrganForces::act(world::SimWorld& world, world::WorldReport&) {
  for (const One& one : all_) {
    cosserat::Load& load = simulation_.rods().loads(one.place.plant)[one.slot];
    const bool on_plant = simulation_.rods().state(one.place.plant).alive[one.place.element];
    load.force_W = on_plant ? one.force_W : Vec3(Vec3::Zero());
    load.moment_W = on_plant ? one.moment_W : Vec3(Vec3::Zero());
    if (!on_plant && !one.force_W.isZero(0.0)) push_fallen(one, world);
  }
}

void OrganForces::push_fallen(const One& one, world::SimWorld& world) const {
  for (const simulation::Detached& fallen : simulation_.plant_step().detached()) {
    if (fallen.plant != one.place.plant || fallen.body < 0) continue;
    const cosserat::Fruit& fruit =
        simulation_.rods().model(fallen.plant).fruits[fallen.event.fruit];
    if (fruit.element != one.place.element) continue;
    // The stub lies along the body's -Z, the fruit's centre at its origin.
    const Vec3 arm(0, 0, fruit.back - one.place.back);
    world.push_body(fallen.body, one.force_W, world.body_pose(fallen.body) * arm);
  }
}

}  // namespace pedicel::app
