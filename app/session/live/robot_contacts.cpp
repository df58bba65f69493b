#include "app/session/live/robot_contacts.h"

#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <btBulletCollisionCommon.h>

#include <optional>
#include <set>
#include <utility>

#include "app/session/live/robot_goal.h"
#include "engine/robot/bullet_types.h"
#include "engine/robot/collision_shapes.h"
#include "engine/world/rigid_shape.h"

namespace pedicel::app {

namespace {

constexpr double deep = 0.002;  // m: less is a touch

/// Where two things overlap most.
struct Deepest : btCollisionWorld::ContactResultCallback {
  const btCollisionObject* first = nullptr;
  double depth = 0.0;              // m
  int link = -1, other_link = -1;  // of the first and of the other thing, where those are a robot's

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                           const btCollisionObjectWrapper* b, int, int) override {
    if (-point.getDistance() <= depth) return 0;
    depth = -point.getDistance();
    if (a->getCollisionObject() != first) std::swap(a, b);
    link = a->getCollisionShape()->getUserIndex();
    other_link = b->getCollisionShape()->getUserIndex();
    return 0;
  }
};

}  // namespace

struct RobotContacts::Shapes {
  explicit Shapes(const Snapshot& now) : assets(now.assets) {
    const robot::KinematicModel model = kinematics_of(now);
    groups = robot::rigid_groups(*assets->robot, model);
    for (const robot::RigidGroup& group : groups) {
      shapes.push_back(robot::group_shape(*assets->robot, group, Pose{}));
      objects.push_back(std::make_unique<btCollisionObject>());
      objects.back()->setCollisionShape(shapes.back().compound.get());
    }
    const auto& ground = now.assets->scene.ground;
    plane = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), ground ? ground->height : 0.0);
    floor.setCollisionShape(plane.get());
    has_floor = ground.has_value();
  }

  void place(const std::vector<Pose>& links) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      objects[g]->setWorldTransform(
          robot::to_bullet(links[static_cast<std::size_t>(groups[g].link)]));
  }

  /// The links that overlap deeply; nothing where none do.
  std::optional<Deepest> overlap(std::size_t group, btCollisionObject& other) {
    Deepest found;
    found.first = objects[group].get();
    if (!shapes[group].parts.empty()) world.contactPairTest(objects[group].get(), &other, found);
    return found.depth > deep ? std::optional(found) : std::nullopt;
  }

  std::string name(int link) const {
    return assets->robot->links[static_cast<std::size_t>(link)].name;
  }

  /// Every "LINK into THING" at the links' poses.
  std::set<std::string> hits(const Snapshot& now, const std::vector<Pose>& links) {
    place(links);
    std::set<std::string> found;
    for (std::size_t g = 1; g < groups.size(); ++g) {
      if (const auto hit = has_floor ? overlap(g, floor) : std::nullopt)
        found.insert(name(hit->link) + " into the ground");
      for (std::size_t other = 0; other < g; ++other) {
        if (groups[g].parent == static_cast<int>(other) || shapes[other].parts.empty()) continue;
        if (const auto hit = overlap(g, *objects[other]))
          found.insert(name(hit->link) + " into " + name(hit->other_link));
      }
    }
    for (const BodySnapshot& body : now.bodies)
      if (body.info->fruit < 0) add_body_hits(body, found);  // fruits lie in the gripper, or roll
    return found;
  }

  void add_body_hits(const BodySnapshot& body, std::set<std::string>& found) {
    const world::RigidShape shape = world::make_rigid_shape(body.info->description);
    btCollisionObject object;
    object.setCollisionShape(shape.compound.get());
    object.setWorldTransform(robot::to_bullet(body.pose * shape.X_BC));
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (const auto hit = overlap(g, object))
        found.insert(name(hit->link) + " into " + body.info->description.name);
  }

  std::shared_ptr<const simulation::SceneAssets> assets;
  std::vector<robot::RigidGroup> groups;
  std::vector<robot::GroupShape> shapes;
  std::vector<std::unique_ptr<btCollisionObject>> objects;
  std::unique_ptr<btStaticPlaneShape> plane;
  btCollisionObject floor;
  bool has_floor = false;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

RobotContacts::RobotContacts() = default;
RobotContacts::~RobotContacts() = default;

const std::string& RobotContacts::at_goal(const Snapshot& now, const std::vector<Pose>& links) {
  if (!now.robot.present || !now.assets || !now.assets->robot) {
    answer_.clear();
    return answer_;
  }
  const bool same = shapes_ && stage_ == now.stage;
  if (same && goal_ == now.robot.goal) return answer_;
  if (!same) shapes_ = std::make_unique<Shapes>(now);
  stage_ = now.stage, goal_ = now.robot.goal;
  const std::set<std::string> here = shapes_->hits(now, now.robot.links);
  answer_.clear();
  for (const std::string& hit : shapes_->hits(now, links))
    if (!here.contains(hit)) answer_ += (answer_.empty() ? "" : ", ") + hit;
  return answer_;
}

}  // namespace pedicel::app
