#include "session/pick_program.h"
#include "session/robot_goal.h"
#include "session/session.h"

namespace pedicel::app {

Result Session::pick(const Command& c) {
  const auto now = snapshot();
  kinematics_of(*now);  // says where there is no robot
  const FruitPlace fruit = find_fruit(*now, c.word("organ"));
  const Vec3 pull = c.has("pull") ? c.point("pull") : usual_pull(*now, fruit);
  return play(pick_program(*now, fruit, pull), false);
}

}  // namespace pedicel::app
