#include "plugins/simulation/link_wrench.h"

#include <algorithm>
#include <utility>

#include "plugins/simulation/body_contacts.h"
#include "plugins/simulation/colliders.h"

namespace pedicel::simulation {

LinkWrench::LinkWrench(Simulation& simulation, int link)
    : simulation_(simulation),
      links_(simulation.robot()->description(), link),
      momentum_(links_.momentum(simulation.robot()->robot().link_poses(),
                                simulation.robot()->robot().link_twists())) {}

robot::Wrench LinkWrench::carried() {
  const robot::Robot& robot = simulation_.robot()->robot();
  const auto now = links_.momentum(robot.link_poses(), robot.link_twists());
  const auto before = std::exchange(momentum_, now);
  return links_.weight(robot.link_poses(), before, now, simulation_.world().dt(),
                       simulation_.scene().gravity) +
         felt(links_.links());
}

robot::Wrench LinkWrench::touch() {
  return felt({links_.link()});
}

// Rigid bodies are Bullet's, among them fruits that came off.
robot::Wrench LinkWrench::felt(const std::vector<int>& by) {
  RobotControl& robot = *simulation_.robot();
  forces_.clear();
  for (const int link : by) {
    const coupling::ContactSum plants =
        simulation_.plant_step().contacts().sum_of_link(robot_body, link);
    forces_.push_back({link, plants.force_W, plants.place_W, plants.moment_W});
  }
  each_body_contact(simulation_.world(), robot.robot(),
                    [&](int link, const Vec3& force_W, const Vec3& place_W) {
                      if (std::ranges::find(by, link) != by.end())
                        forces_.push_back({link, force_W, place_W, Vec3::Zero()});
                    });
  return links_.felt(robot.link_poses(), forces_);
}

}  // namespace pedicel::simulation
