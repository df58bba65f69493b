#include "plugins/simulation/colliders.h"

#include <algorithm>

#include "engine/geometry/shapes.h"
#include "engine/robot/shape_field.h"
#include "plugins/simulation/mesh_fields.h"

namespace pedicel::simulation {

namespace {

using Field = std::shared_ptr<const geometry::SignedDistance>;

Field field_of(const robot::Geometry& g, const MeshDistances& meshes) {
  Field field = robot::shape_field(g);
  // By the mesh, not by the link: many links share one.
  return field ? field : meshes.at(g.mesh.get());
}

Field field_of(const world::BodyPart& part) {
  switch (part.kind) {
    case world::BodyPart::Kind::box:
      return std::make_shared<geometry::BoxDistance>(2.0 * part.half_extents);
    case world::BodyPart::Kind::sphere:
      return std::make_shared<geometry::SphereDistance>(part.radius);
    case world::BodyPart::Kind::cylinder:
      return std::make_shared<geometry::CylinderDistance>(part.radius, part.length);
    case world::BodyPart::Kind::capsule:
      return std::make_shared<geometry::CapsuleDistance>(part.radius, part.length);
  }
  return nullptr;
}

ShapeFields fields_with(const robot::RobotDescription& robot, const MeshDistances& meshes) {
  ShapeFields fields;
  for (const robot::Link& link : robot.links) {
    fields.emplace_back();
    for (const robot::Collision& collision : link.collisions)
      fields.back().push_back(field_of(collision.geometry, meshes));
  }
  return fields;
}

}  // namespace

ShapeFields fields_of(const robot::RobotDescription& robot, std::vector<std::string>& notes) {
  return fields_with(robot, build_mesh_fields(robot, notes));
}

ShapeFields exact_fields_of(const robot::RobotDescription& robot) {
  return fields_with(robot, exact_mesh_fields(robot));
}

void add_robot_colliders(coupling::ColliderSet& set, const std::string& name,
                         const robot::RobotDescription& robot, const ShapeFields& fields,
                         const std::vector<Pose>& link_poses,
                         const std::map<int, double>& friction) {
  for (std::size_t l = 0; l < robot.links.size(); ++l) {
    const std::vector<robot::Collision>& collisions = robot.links[l].collisions;
    for (std::size_t c = 0; c < collisions.size(); ++c) {
      coupling::Collider collider;
      // All parts of a link have one name: forces on a link are summed by it.
      collider.name = name + "/" + robot.links[l].name;
      collider.body = robot_body;
      collider.link = static_cast<int>(l);
      collider.shape = fields[l][c];
      collider.X_LC = collisions[c].X_LC;
      if (const auto own = friction.find(static_cast<int>(l)); own != friction.end())
        collider.friction = std::min(own->second, 10.0);
      set.add(std::move(collider), link_poses[l]);
    }
  }
}

void add_body_colliders(coupling::ColliderSet& set, const world::BodyDescription& body, int index,
                        const Pose& X_WB) {
  for (const world::BodyPart& part : body.parts) {
    coupling::Collider collider;
    collider.name = body.name;
    collider.body = index;
    collider.shape = field_of(part);
    collider.X_LC = part.pose;
    collider.friction = std::min(body.friction, 1.0);
    set.add(std::move(collider), X_WB);
  }
}

void add_ground_collider(coupling::ColliderSet& set, const world::GroundPlane& ground) {
  coupling::Collider collider;
  collider.name = "ground";
  collider.body = ground_body;
  collider.shape = std::make_shared<geometry::PlaneDistance>(Vec3::UnitZ(), ground.height);
  collider.friction = std::min(ground.friction, 1.0);
  set.add(std::move(collider), Pose{});
}

}  // namespace pedicel::simulation
