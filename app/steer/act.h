#pragma once

#include <string>
#include <vector>

namespace pedicel::app {

/// Something that is done to a run from outside between two steps: as plain data, so that it can be
/// kept and done again.
struct Act {
  enum class Kind {
    position,  ///< `numbers`: a target a joint (rad or m); not a number: as it is
    velocity,  ///< likewise, rad/s or m/s
    torque,    ///< likewise, N m or N
    go_to,     ///< `numbers`: joint positions (rad or m) that the robot moves evenly to
    force,     ///< `name` an organ; `numbers`: place at (1), force (N, 3), moment (N m, 3)
    no_forces,
    push,  ///< `name` a body; `numbers`: force (N, 3) for one step, at a point (m, 3)
    set,   ///< `name` "KEY=VALUE"
    cut,   ///< `name` an organ; `numbers`: place at (1)
  };
  static constexpr int kinds = 9;

  long step = 0;  ///< the steps done before it
  Kind kind = Kind::position;
  std::string name;
  std::vector<double> numbers;
  bool operator==(const Act& other) const;
};

/// One line a list of acts, exact, and the way back. Throws UsageError where it is none.
std::string to_text(const Act& act);
Act act_of_text(const std::string& line);

}  // namespace pedicel::app
