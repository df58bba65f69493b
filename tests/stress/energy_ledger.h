#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/solver/detachment.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::stress {

/// One step, seen from outside.
struct BookedStep {
  const cosserat::RodState& before;  ///< with the clamp where it was at the end of the step before
  const cosserat::RodState& after;
  double dt = 0.0;  ///< s
  std::span<const cosserat::Load> loads;
  std::span<const cosserat::ContactForce> contacts;
  /// What the colliders half way through the step, and at its end, would touch of the plant at the
  /// step's start.
  std::span<const cosserat::ContactPoint> meeting_half_way, meeting;
  std::span<const cosserat::DetachEvent> detached;
  bool is_converged = true;
};

/// Books the energy of one plant.
///
/// Found: kinetic + elastic + that of the contacts' springs, F^2 / (2 k) for normal and friction.
///
/// Put in: what was there at the start + the fall in gravity + the work of loads, colliders and the
/// clamp - what left with fruits that came off. Work is force times displacement in each step, with
/// the force at the step's end: for a potential U(x, s) of the plant's places x and the driven
/// places s, convex within the step, U(n+1) - U(n) <= dU/dx . dx + dU/ds . ds, both taken at the
/// end, and backward Euler's balance, M dv/dt = -dU/dx, gives
///   E(n+1) - E(n) <= -1/2 |dv|_M^2 + dU/ds . ds  <=  force . ds.
/// So found <= put in, without any slack, for a converged step of backward Euler; what compressed
/// rods lack in convexity is second order in the step. Colliders and clamps that stand still can do
/// no work, nor can self-contact.
///
/// Where a step did not converge, the force at its end is not what moved the plant. All that is
/// left is that a step descends in its potential: the driven places go first, and the plant gets
/// what they can have done while it held still. So there the energy counts that the clamp presses
/// into the springs and dampers of the segments at it, and the colliders into the contact springs
/// of the plant at its old place, with the work of friction |force| |ds|. Such a step may have been
/// taken in two halves: then the colliders press half way, and once more at the end.
///
/// Allowed: put in + as much again as was ever put in. BDF2 bounds not E but
/// G(n) = 1/4 (|y(n)|^2 + |2 y(n) - y(n-1)|^2), y the state in the norm of energy (Dahlquist, BIT
/// 18, 1978; Hairer & Wanner, Solving Ordinary Differential Equations II, section V.6), and E(n) =
/// 1/2 |y(n)|^2 <= 2 G(n). No slack grows with the number of steps: a scheme that feeds itself is
/// found out.
class EnergyLedger {
 public:
  EnergyLedger(const cosserat::RodModel& model, const cosserat::RodState& start,
               const Vec3& gravity, cosserat::Integrator integrator);

  void book(const cosserat::RodModel& model, const BookedStep& step);

  double found() const { return found_; }  ///< J
  double allowed() const { return put_in_ + slack(); }
  /// By how much more was found than put in, as a share of the slack: 1 is the most.
  double excess() const { return (found_ - put_in_) / slack(); }

 private:
  /// What is known of the clamp's joint with one element.
  struct Root {
    int element = 0;
    cosserat::Strain strain;  // at the end of the step before
    cosserat::Strain change;  // in the step before
  };
  double slack() const;
  double clamp_work(const cosserat::RodModel& model, const BookedStep& step);
  double pressed_by_clamp(const cosserat::RodModel& model, const BookedStep& step,
                          const Root& root) const;
  double pressed_by_colliders(const BookedStep& step) const;
  Vec3 rate(const Vec3& change, const Vec3& change_before, double dt) const;

  Vec3 gravity_;
  bool is_second_order_;
  bool has_history_ = false;
  std::vector<Root> roots_;
  Vec3 shift_ = Vec3::Zero(),
       turn_ = Vec3::Zero();  // m and rad, W: of the clamp in the step before
  double work_ = 0.0;         // J, the start's energy and all work since
  double springs_ = 0.0, found_ = 0.0, put_in_ = 0.0, largest_ = 0.0;  // J
};

}  // namespace pedicel::stress
