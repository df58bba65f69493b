#include "core/check.h"
#include "session/pick_program.h"
#include "session/robot_goal.h"
#include "session/session.h"

namespace pedicel::app {

Result Session::pick(const Command& c) {
  const auto now = snapshot();
  kinematics_of(*now);  // says where there is no robot
  const FruitPlace fruit = find_fruit(*now, c.word("organ"));
  if (c.has("pull")) return play(pick_program(*now, fruit, c.point("pull")), false);
  // As far as the arm comes.
  for (const double share : {1.0, 0.75, 0.5}) {
    try {
      return play(pick_program(*now, fruit, share * usual_pull(*now, fruit)), false);
    } catch (const UsageError&) {
      if (share == 0.5) throw;
    }
  }
  return {};
}

}  // namespace pedicel::app
