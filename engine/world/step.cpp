#include "engine/world/step.h"

#include <numeric>

namespace pedicel::world {

std::string_view name_of(Phase phase) {
  static constexpr std::array<std::string_view, phase_count> names = {
      "commands", "control", "bullet", "plants", "observe", "record"};
  return names[static_cast<int>(phase)];
}

std::string remedy(WorldError error) {
  switch (error) {
    case no_error:
      return "";
    case plant_not_converged:
      return "raise rods.newton_iterations or lower dt";
    case plant_not_finite:
      return "lower dt, or check stiffness and mass of the organ";
    case robot_not_finite:
      return "lower dt, or check the joint's inertia and the control gains";
    case body_not_finite:
      return "lower dt, or check the body's mass";
  }
  return "";
}

double WorldReport::wall_seconds() const {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

}  // namespace pedicel::world
