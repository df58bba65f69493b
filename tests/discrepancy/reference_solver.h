#pragma once

#include <functional>
#include <vector>

#include "tests/discrepancy/reference_joint.h"
#include "tests/discrepancy/reference_tree.h"

namespace pedicel::reference {

/// What acts on a point: its force (N, W) and the stiffness (N/m) with which it answers motion.
struct PointPush {
  Vec3 force = Vec3::Zero();
  double stiffness = 0.0;
};

/// `time` is the stage's, `middle` the middle of the step: what switches, switches by the latter.
using PointLaw = std::function<PointPush(double time, double middle, const Vec3& position,
                                         const Vec3& velocity)>;

struct PointForce {
  Place place;
  PointLaw law;
};

/// What surrounds a plant. The clamp's pose is relative to where it was drawn.
struct Surroundings {
  Vec3 gravity = Vec3(0, 0, -9.81);
  std::vector<PointForce> forces;
  std::function<Pose(double time)> clamp;  ///< absent: it stands still
  double clock = 0.0;                      ///< s, for drift
};

/// A tree of rigid segments on ball joints in joint coordinates.
///
/// Each stage of R. Alexander's third-order L-stable SDIRK method (SIAM J. Numer. Anal. 14, 1977)
/// is solved for the joints' accelerations by a fixed-point iteration whose matrix, mass + gamma h
/// damping + (gamma h)^2 stiffness of joints and springs, is eliminated joint by joint
/// (R. Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 7): O(n), and stiff joints cost
/// no smaller step.
class Solver {
 public:
  Solver(Tree tree, Surroundings surroundings);

  /// Static equilibrium at time 0. False where it was not reached.
  bool settle();
  /// phi (rad) of every joint as it settled.
  const std::vector<Vec3>& settled() const { return settled_; }
  /// Where hung memory terms had relaxed to, as settled() of the relaxed plant; before settle().
  void hang(const std::vector<Vec3>& phi);
  /// Advances by h (s).
  void step(double h);

  double time() const { return time_; }
  const Tree& tree() const { return tree_; }
  Surroundings& surroundings() { return around_; }

  Vec3 position(const Place& place) const;
  Vec3 velocity(const Place& place) const;
  Mat3 rotation(int segment) const { return body_[segment].R; }
  /// N and N m, W: force and moment of the clamp on the plant, about the clamp as it is now. What
  /// it carries: all that is accelerated, less gravity and what pulls and pushes. `middle` says on
  /// which side of a jump that is, as for PointLaw. After settle() or step().
  Eigen::Matrix<double, 6, 1> root_wrench(double middle);
  /// Bending (rad over the joint's length, 1/m) of a joint from its unloaded shape.
  double curvature(int segment) const;
  /// Kinetic, elastic and potential energy together, J, with plain joints and without springs.
  double energy() const;
  int iterations() const { return iterations_; }

 private:
  struct Body {
    Mat3 R;
    Vec3 p, v, w;     // W: the joint's place and velocity, angular velocity
    Vec3 a, alpha;    // of the iterate
    Vec3 zeta, beta;  // velocity terms of alpha and of a
    Vec3 step;        // to the far end, W
    Mat3 A, B, M;     // articulated inertia about the joint, W
    Vec3 n, f;        // bias wrench
    Mat3 P, PA, PB;   // of the elimination
    Vec3 x0, x;       // joint acceleration, W
  };
  struct Stage {
    std::vector<Vec3> theta_known, rate_known, theta_rate, accel;
    std::vector<Vec3> q, q_rate;
  };

  void place_bodies();
  void gather(double inertia_scale, double weight, double time, double middle);
  void add_point(const PointForce& point, double weight, double time, double middle);
  void eliminate();
  void descend(bool moving);
  void solve_stage(int s, double h);
  void joint_terms(double gh, bool dynamic);
  void set_clamp(int stage, double h);

  Tree tree_;
  Surroundings around_;
  double time_ = 0.0;
  int iterations_ = 0;

  std::vector<Quat> relative_, trial_relative_;
  std::vector<Vec3> rate_, trial_rate_, accel_, settled_, hung_;
  std::vector<JointPast> past_, trial_past_;
  std::vector<Vec3> q_, q_known_, trial_q_;
  std::vector<Vec3> torque_;      // E, with the implicit part
  std::vector<Mat3> joint_mass_;  // E, gamma h D + (gamma h)^2 K
  std::vector<Body> body_;
  Stage stage_[3];

  struct Clamp {
    Mat3 R = Mat3::Identity();
    Vec3 p = Vec3::Zero(), v = Vec3::Zero(), w = Vec3::Zero(), a = Vec3::Zero(),
         alpha = Vec3::Zero();
  } clamp_, clamp_start_;
  Vec3 clamp_v_[3], clamp_a_[3], clamp_w_[3], clamp_alpha_[3];
};

}  // namespace pedicel::reference
