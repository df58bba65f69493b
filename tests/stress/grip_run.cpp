#include "tests/stress/grip_run.h"

#include <algorithm>
#include <cmath>

#include "engine/core/timer.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/simulation/colliders.h"
#include "tests/stress/sentence.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::stress {

namespace {

constexpr double filter_time = 0.02;  // s
constexpr double blurred = 0.01;  // 1, of normal forces: a tool that turns by 0.6 degrees a step
constexpr double force_tolerance = 1.1;  // 1
constexpr double most_sunk = 0.8;        // 1
constexpr double holds_for = 0.9;        // 1, of friction
constexpr double along_way = 0.7;        // 1
constexpr double at_stop = 1.0e-3;       // m: a step in parts may meet it and come off again
constexpr double felt = 0.05;            // N
constexpr double lost_for = 0.1;         // s

/// What the fingers feel in a step.
struct Feel {
  double opening = 0.0;     // N, on the joint
  double normal = 0.0;      // N, sum of sizes
  double tangential = 0.0;  // N
  double sunk = 0.0;        // 1, of the radius
};

Feel feel_of(const simulation::Simulation& sim) {
  Feel feel;
  const simulation::RobotControl& robot = *sim.robot();
  const int left = robot.description().link("left_finger");
  const int right = robot.description().link("right_finger");
  for (const cosserat::ContactForce& contact : sim.rods().contact_forces(0)) {
    if (cosserat::is_self_contact(contact.point.collider)) continue;
    const coupling::Collider& collider = sim.colliders().collider(contact.point.collider);
    if (collider.body != simulation::robot_body ||
        (collider.link != left && collider.link != right))
      continue;
    // What an edge pushes across the way that the fingers close is the arm's.
    const Vec3 outward_W = robot.link_pose(collider.link).rotation * Vec3::UnitY();
    feel.opening -= contact.normal * contact.point.normal_W.dot(outward_W);
    feel.normal += contact.normal;
    feel.tangential += contact.tangential_W.norm();
    if (std::abs(contact.point.normal_W.dot(outward_W)) > along_way)
      feel.sunk = std::max(feel.sunk, -contact.point.gap / contact.point.radius);
  }
  // Its stop bears anything.
  const int joint = robot.gripper();
  if (robot.robot().positions()[joint] > robot.robot().model().upper()[joint] - at_stop)
    feel.opening = 0.0;
  return feel;
}

class Judge {
 public:
  Judge(const GripCase& one, GripOutcome& outcome) : one_(one), outcome_(outcome) {}

  void step(const simulation::Simulation& sim, const world::WorldReport& report) {
    const double dt = sim.world().dt();
    outcome_.unsolved += (report.errors & world::plant_not_converged) != 0;
    outcome_.broken = !sim.plant_step().detached().empty();
    const Feel feel = feel_of(sim);
    const double opening = feel.opening - blurred * feel.normal;
    filtered_ += dt / (dt + filter_time) * (opening - filtered_);
    const double allowed = one_.pressing() + GripCase::joint_friction();
    outcome_.force_used = std::max(outcome_.force_used, filtered_ / allowed);
    outcome_.sunk = std::max(outcome_.sunk, feel.sunk);
    outcome_.gripped = outcome_.gripped || feel.normal > felt;
    if (feel.normal > felt)
      outcome_.friction_used =
          std::max(outcome_.friction_used, feel.tangential / (one_.friction * feel.normal));
    free_ = feel.normal > felt ? 0.0 : free_ + dt;
    say_fault(report);
  }

  void end() {
    outcome_.lost = outcome_.gripped && !outcome_.broken && free_ > lost_for;
    if (outcome_.fault.empty() && outcome_.lost && outcome_.friction_used < holds_for)
      outcome_.fault = sentence("lost, where friction carried %.3g of what it can at most",
                                outcome_.friction_used);
  }

 private:
  void say_fault(const world::WorldReport& report) {
    if (!outcome_.fault.empty()) return;
    if (report.errors & world::fatal_errors)
      outcome_.fault = sentence("unstable at %.4f s: %s", report.time, report.culprit.c_str());
    else if (!std::isfinite(report.plant_energy))
      outcome_.fault = sentence("energy is not finite at %.4f s", report.time);
    else if (outcome_.force_used > force_tolerance)
      outcome_.fault =
          sentence("presses with %.3g of its force at %.4f s", outcome_.force_used, report.time);
    else if (outcome_.sunk > most_sunk)
      outcome_.fault =
          sentence("sinks in by %.3g of the radius at %.4f s", outcome_.sunk, report.time);
  }

  const GripCase& one_;
  GripOutcome& outcome_;
  double filtered_ = 0.0, free_ = 0.0;  // N, s
};

}  // namespace

GripOutcome run_grip(const GripCase& one) {
  GripOutcome outcome;
  const TemporaryFolder folder;
  const auto sim = make_grip(one, folder / "");
  Judge judge(one, outcome);
  const Timer timer;
  const long steps = std::lround(one.duration() / sim->world().dt());
  for (long i = 0; i < steps && outcome.fault.empty(); ++i) judge.step(*sim, sim->step());
  judge.end();
  outcome.seconds = timer.seconds();
  return outcome;
}

}  // namespace pedicel::stress
