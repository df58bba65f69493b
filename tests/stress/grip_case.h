#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/core/frames.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::stress {

/// A gripper shuts on a stalk, a stem or a fruit, drags it, turns it and shakes it. Everything
/// about it follows from its seed.
struct GripCase {
  enum class Thing { stem, stalk, fruit };
  std::uint64_t seed = 0;
  Thing thing = Thing::stem;  ///< what stands between the pads; a stalk carries a fruit at its end
  bool two_way = false;
  double radius = 0.0;          ///< m, of the stem or stalk
  double fruit_radius = 0.0;    ///< m
  double youngs_modulus = 0.0;  ///< Pa
  double damping_time = 0.0;    ///< s
  double element = 0.0;         ///< m, sampling distance
  Vec3 along = Vec3::UnitZ();   ///< unit, W, of the stem
  double before = 0.0;          ///< m, from the clamp to the grip
  double after = 0.0;           ///< m, from the grip to the stem's end, or to the fruit
  std::string detach;           ///< as in a plant file; empty: nothing breaks
  double effort = 0.0;          ///< N, of the URDF
  double force = 0.0;           ///< N, the scene's gripper_force; 0: none
  double velocity = 0.0;        ///< m/s, of the URDF
  double shut = 0.0;            ///< m, the gripper's target
  double closing = 0.0;         ///< s
  double friction = 0.0;        ///< 1
  double contact_stiffness = 0.0, fruit_stiffness = 0.0;  ///< N/m
  Vec3 pull = Vec3::Zero();                               ///< m, W
  double turn = 0.0;                                      ///< rad, about the way the tool points
  Vec3 shake = Vec3::Zero();                              ///< m, W, amplitude
  double frequency = 0.0;                                 ///< Hz

  /// N, what the joint presses with, less or more its friction.
  double pressing() const;
  /// N, of the gripper's joint and its mirror.
  static double joint_friction();
  double duration() const;  ///< s
};

/// Draws the case of a seed: the same on every machine.
GripCase draw_grip(std::uint64_t seed);

/// One line that says what it is.
std::string describe(const GripCase& one);

/// Writes its plant, robot and scene into a folder and reads them: as the program runs them.
std::unique_ptr<simulation::Simulation> make_grip(const GripCase& one,
                                                  const std::filesystem::path& folder);

}  // namespace pedicel::stress
