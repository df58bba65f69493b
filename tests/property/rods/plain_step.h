#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/solver/rod_solver.h"
#include "tests/property/rods/plain_joint.h"
#include "tests/property/rods/plain_system.h"

namespace pedicel::plain {

/// Where the elements of a plant are.
struct Place {
  std::vector<Vec3> position;     ///< m, W, child nodes
  std::vector<Quat> orientation;  ///< E to W
};

Place place_of(const cosserat::RodState& state);

/// Moved by a solution of Newton's system.
Place moved(const Place& place, const std::vector<Six>& change, double share = 1.0);

/// The incremental potential of one step of one plant (plugins/cosserat/README.md), one element
/// after the other, from the states alone.
class Step {
 public:
  /// From `now`, whose memory of laws must have been begun, by `dt` (s); `before`: the state a step
  /// of the same length earlier, for a step of second order, else null. All must outlive it.
  Step(const cosserat::RodModel& model, const cosserat::RodState& now,
       const cosserat::RodState* before, double dt, const Vec3& gravity,
       std::span<const cosserat::Load> loads);

  /// The motion continued at constant velocity.
  Place first_guess() const;
  /// J, where what turns with the iterate (axes of drag, moments of loads) is as it is at `about`.
  double potential(const Place& place, const Place& about) const;
  /// Newton's system: Gauss-Newton and the tension's geometric stiffness.
  System linearise(const Place& place) const;
  /// What the step leaves: velocities and memory of the elements that are alive.
  cosserat::RodState end(const Place& place) const;

 private:
  struct Terms {                 // of one element
    Pose past;                   // c* and q*
    Vec3 com_target;             // m, W
    Quat rotation_target;        // E to W
    double inertia_scale = 0.0;  // 1/s2
    Vec3 stretch_rate;           // N
    Vec3 stretch_target = Vec3::Zero();
    JointStep joint;
    Vec3 middle_past = Vec3::Zero(), air = Vec3::Zero();
    double drag = 0.0;  // N/(m/s)2
  };
  struct Strained {  // of one element at a place
    Mat3 r;
    Vec3 along, stretch, phi, off, turn;
    Quat from_target;
  };
  struct Air {  // its relative velocity across the segment, m/s
    Vec3 u;
    double speed;
  };

  Terms terms_of(int element) const;
  Pose parent_of(int element, const Place& place) const;
  Strained strained(int element, const Place& place) const;
  Vec3 middle_of(int element, const Pose& own) const;
  Air air_of(int element, const Pose& own, const Vec3& axis) const;
  double potential_of(int element, const Place& place, const Place& about) const;
  void add_element(int element, const Place& place, System& system) const;
  void add_drag(int element, const Place& place, System& system) const;
  void add_attachments(const Place& place, System& system) const;

  const cosserat::RodModel& model_;
  const cosserat::RodState& now_;
  const cosserat::RodState* before_;
  double dt_, h_;  // s
  double a_, b_;   // 1, x* = a x - b x_before
  Vec3 gravity_;
  std::span<const cosserat::Load> loads_;
  std::vector<Terms> terms_;
};

/// Newton's method with a backtracking line search, until the change is below `tolerance` (m and
/// rad). Empty where it does not get there.
std::optional<Place> minimise(const Step& step, const Place& from, double tolerance);

}  // namespace pedicel::plain
