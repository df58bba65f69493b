#include "plugins/simulation/place.h"

namespace pedicel::simulation {

std::optional<FallenFruit> fallen_fruit(const Simulation& simulation, int plant, int fruit) {
  const world::SimWorld& world = simulation.world();
  const cosserat::RodSystem& rods = simulation.rods();
  if (!rods.state(plant).fruit_gone[fruit]) return std::nullopt;
  if (const auto carried = simulation.cutting().carried(plant, fruit)) {
    const Pose pose = world.body_pose(carried->body);
    const Vec3 arm = pose.rotation * carried->centre_B;
    return FallenFruit{
        carried->body, pose.position + arm,
        world.body_velocity(carried->body) + world.body_angular_velocity(carried->body).cross(arm),
        true};
  }
  // As soon as it is off, a fruit is a body of its own name.
  const int body = world.body_index(fruit_name(rods.model(plant), fruit));
  if (body < 0) return std::nullopt;
  return FallenFruit{body, world.body_pose(body).position, world.body_velocity(body)};
}

std::optional<Vec3> place_of(const Simulation& simulation, const world::Anchor& anchor) {
  const world::SimWorld& world = simulation.world();
  const cosserat::RodSystem& rods = simulation.rods();
  const RobotControl* robot = simulation.robot();
  if (anchor.kind == world::Anchor::Kind::tool && robot) return robot->tool_pose().position;
  if (anchor.kind == world::Anchor::Kind::body) {
    const int body = world.body_index(anchor.name);
    if (body >= 0) return world.body_pose(body).position;
    return std::nullopt;
  }
  for (int p = 0; p < rods.size(); ++p) {
    const cosserat::RodModel& model = rods.model(p);
    if (anchor.kind == world::Anchor::Kind::plant && model.name == anchor.name)
      return model.root.position;
    if (anchor.kind != world::Anchor::Kind::fruit) continue;
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      if (fruit_name(model, f) != anchor.name) continue;
      if (const auto fallen = fallen_fruit(simulation, p, f)) return fallen->centre;
      return cosserat::point_on(model, rods.state(p), model.fruits[f].element,
                                model.fruits[f].back);
    }
  }
  return std::nullopt;
}

}  // namespace pedicel::simulation
