#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/robot/description.h"
#include "engine/world/sim_world.h"
#include "plugins/coupling/collider.h"

/// From the things of a world to the distance fields that plants feel. Collider::body says whose a
/// field is: the numbers below, or the index of a rigid body.
namespace pedicel::simulation {

inline constexpr int robot_body = -2;
inline constexpr int ground_body = -1;

/// The distance field of every collision shape, [link][collision].
using ShapeFields = std::vector<std::vector<std::shared_ptr<const geometry::SignedDistance>>>;

/// Exact for primitives; for meshes as mesh_fields.h says, one for all shapes that share a mesh. A
/// problem with the cache and meshes that are large are added to `notes`, one sentence each.
ShapeFields fields_of(const robot::RobotDescription& robot, std::vector<std::string>& notes);

/// The same, exact for meshes, too, without grids: where there are no plants, nobody asks for
/// thousands of distances a step, but the window picks and draws on robots.
ShapeFields exact_fields_of(const robot::RobotDescription& robot);

/// Adds one collider a collision shape of every link, named "robot/LINK". `fields` is fields_of()
/// the robot; `link_poses` (X_WL) is where the links are now. `friction`: of links that have their
/// own against plants.
void add_robot_colliders(coupling::ColliderSet& set, const std::string& name,
                         const robot::RobotDescription& robot, const ShapeFields& fields,
                         const std::vector<Pose>& link_poses,
                         const std::map<int, double>& friction = {});

/// Adds one collider a part of a rigid body, named after the body.
void add_body_colliders(coupling::ColliderSet& set, const world::BodyDescription& body, int index,
                        const Pose& X_WB);

void add_ground_collider(coupling::ColliderSet& set, const world::GroundPlane& ground);

}  // namespace pedicel::simulation
