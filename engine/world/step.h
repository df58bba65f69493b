#pragma once

#include <array>
#include <string>
#include <string_view>

namespace pedicel::world {

class SimWorld;

/// The phases of a step, in their order. SimWorld::step() is the one place that runs them.
enum class Phase {
  commands,  ///< what the user or a program asked for since the last step
  control,   ///< robots turn targets into joint torques and motors
  bullet,    ///< robots and rigid bodies move
  plants,    ///< from Bullet's tick: contact fields at the new poses, rods, detachment
  observe,   ///< read only
  record,    ///< read only
};
inline constexpr int phase_count = 6;
std::string_view name_of(Phase phase);

/// What went wrong in a step; each bit's remedy is in remedy().
enum WorldError : unsigned {
  no_error = 0,
  plant_not_converged = 1,  ///< a rod solver's last change is too large: the step counts, inexactly
  plant_not_finite = 2,     ///< a plant's positions are no numbers any more, or beyond all bounds
  robot_not_finite = 4,
  body_not_finite = 8,
};
std::string remedy(WorldError error);

/// The errors after which a run cannot go on (exit code 4).
inline constexpr unsigned fatal_errors = plant_not_finite | robot_not_finite | body_not_finite;

/// What a step of the world did, all of its phases together.
struct WorldReport {
  double time = 0.0;             ///< s, at the end of the step
  unsigned errors = no_error;    ///< bits of WorldError
  std::string culprit;           ///< the organ, joint or body of the worst error; empty: none
  std::string cause;             ///< of a fatal error: which quantity, and its value
  double worst_residual = 0.0;   ///< m or rad, of the rods' last iteration
  double deepest_overlap = 0.0;  ///< m, of a plant and what it touches
  int contacts = 0;              ///< between plants and others
  double plant_energy = 0.0;     ///< J, kinetic + elastic + gravity
  std::array<double, phase_count> seconds{};  ///< wall time a phase

  double seconds_of(Phase phase) const { return seconds[static_cast<int>(phase)]; }
  double wall_seconds() const;
};

/// Takes part in a step and may change the world, in the one phase that it declares (commands,
/// control or plants). act() neither throws, nor prints, nor allocates once warm.
class Participant {
 public:
  virtual ~Participant() = default;
  virtual Phase phase() const = 0;
  virtual void act(SimWorld& world, WorldReport& report) = 0;
};

/// Looks at the world after each step.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void observe(const SimWorld& world, const WorldReport& report) = 0;
};

}  // namespace pedicel::world
