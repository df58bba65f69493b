#include "tests/discrepancy/reference_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/discrepancy/reference_rotation.h"

namespace pedicel::reference {

namespace {

// Alexander's coefficients: gamma is the root of x^3 - 3x^2 + 3x/2 - 1/6 near 0.436.
constexpr double gamma_ = 0.43586652150845899942;
constexpr double a21 = 0.5 * (1.0 - gamma_);
constexpr double b1 = -1.5 * gamma_ * gamma_ + 4.0 * gamma_ - 0.25;
constexpr double b2 = 1.5 * gamma_ * gamma_ - 5.0 * gamma_ + 1.25;
constexpr double tableau[3][3] = {{gamma_, 0, 0}, {a21, gamma_, 0}, {b1, b2, gamma_}};
constexpr double stage_time[3] = {gamma_, 0.5 * (1.0 + gamma_), 1.0};
constexpr double air_density = 1.2;  // kg/m3
constexpr double tolerance = 1e-8;  // rad, of the last change within a stage; the next is 100x less
constexpr int most_iterations = 60;

}  // namespace

Solver::Solver(Tree tree, Surroundings surroundings)
    : tree_(std::move(tree)), around_(std::move(surroundings)) {
  const int n = tree_.size();
  const std::size_t memories = n * tree_.law.memory.size();
  for (const Segment& s : tree_.segments) relative_.push_back(s.joint.rest);
  trial_relative_ = relative_;
  for (auto* v : {&rate_, &trial_rate_, &accel_, &settled_, &hung_, &torque_})
    v->assign(n, Vec3::Zero());
  past_.resize(n);
  trial_past_.resize(n);
  for (auto* v : {&q_, &q_known_, &trial_q_}) v->assign(memories, Vec3::Zero());
  joint_mass_.assign(n, Mat3::Zero());
  body_.resize(n);
  for (Stage& stage : stage_) {
    for (auto* v : {&stage.theta_known, &stage.rate_known, &stage.theta_rate, &stage.accel})
      v->assign(n, Vec3::Zero());
    for (auto* v : {&stage.q, &stage.q_rate}) v->assign(memories, Vec3::Zero());
  }
  if (around_.clamp) {
    clamp_.R = around_.clamp(0.0).rotation.toRotationMatrix();
    clamp_.p = around_.clamp(0.0) * tree_.root;
  } else {
    clamp_.p = tree_.root;
  }
  place_bodies();
}

void Solver::hang(const std::vector<Vec3>& phi) {
  hung_ = phi;
  const std::size_t memories = tree_.law.memory.size();
  for (int i = 0; i < tree_.size(); ++i)
    for (std::size_t m = 0; m < memories; ++m)
      if (tree_.law.memory[m].hung) q_[i * memories + m] = phi[i];
}

// Poses, velocities and accelerations of the iterate, from the root on.
void Solver::place_bodies() {
  for (int i = 0; i < tree_.size(); ++i) {
    const Segment& s = tree_.segments[i];
    Body& b = body_[i];
    Vec3 w_parent, alpha_parent;
    if (s.parent < 0) {
      b.R = clamp_.R * trial_relative_[i].toRotationMatrix();
      b.p = clamp_.p;
      b.v = clamp_.v;
      b.beta.setZero();
      b.a = clamp_.a;
      w_parent = clamp_.w;
      alpha_parent = clamp_.alpha;
    } else {
      const Body& parent = body_[s.parent];
      b.R = parent.R * trial_relative_[i].toRotationMatrix();
      b.p = parent.p + parent.step;
      b.v = parent.v + parent.w.cross(parent.step);
      b.beta = parent.w.cross(parent.w.cross(parent.step));
      b.a = parent.a + parent.alpha.cross(parent.step) + b.beta;
      w_parent = parent.w;
      alpha_parent = parent.alpha;
    }
    const Vec3 own = b.R * trial_rate_[i];
    b.w = w_parent + own;
    b.zeta = w_parent.cross(own);
    b.alpha = alpha_parent + b.zeta + b.R * accel_[i];
    b.step = b.R.col(2) * s.length;
  }
}

// Inertia about each joint and the wrench that acts there, velocity terms on the other side.
void Solver::gather(double inertia_scale, double weight, double time, double middle) {
  for (int i = 0; i < tree_.size(); ++i) {
    const Segment& s = tree_.segments[i];
    Body& b = body_[i];
    const Vec3 c = b.R.col(2) * s.centre;
    const Mat3 J = b.R * s.inertia.asDiagonal() * b.R.transpose();
    const Vec3 spin = J * b.w, weight_force = s.mass * around_.gravity;
    b.A = inertia_scale * J;
    b.B = inertia_scale * s.mass * skew(c);
    b.M = inertia_scale * s.mass * Mat3::Identity();
    b.n = b.w.cross(spin) - c.cross(weight_force);
    b.f = s.mass * b.w.cross(b.w.cross(c)) - weight_force;
    if (tree_.mass_damping > 0.0) {
      b.n += tree_.mass_damping * (spin + s.mass * c.cross(b.v));
      b.f += tree_.mass_damping * s.mass * (b.v + b.w.cross(c));
    }
    for (const Air& air : tree_.air) {
      if (air.curve >= 0 && air.curve != s.curve) continue;
      const Vec3 arm = 0.5 * b.step, axis = b.R.col(2);
      const double gust = 1.0 + air.amplitude * std::sin(2.0 * M_PI * air.frequency * time);
      Vec3 u = gust * air.velocity - (b.v + b.w.cross(arm));
      const double whole = 0.5 * air_density * s.length;
      Vec3 force;
      if (air.normal.isZero(0.0)) {
        u -= u.dot(axis) * axis;
        force = whole * air.area * u.norm() * u;
      } else {
        const Vec3 n = b.R * (s.drawn.conjugate() * air.normal), along = u.dot(n) * n;
        force = whole *
                (air.area * along.norm() * along + air.across * (u - along).norm() * (u - along));
      }
      b.n -= arm.cross(force);
      b.f -= force;
    }
  }
  for (const PointForce& point : around_.forces) add_point(point, weight, time, middle);
}

void Solver::add_point(const PointForce& point, double weight, double time, double middle) {
  Body& b = body_[point.place.segment];
  const Vec3 d = b.R.col(2) * point.place.along;
  const PointPush push = point.law(time, middle, b.p + d, b.v + b.w.cross(d));
  const double k = weight * push.stiffness;
  const Mat3 cross = skew(d);
  b.A -= k * cross * cross;
  b.B += k * cross;
  b.M += k * Mat3::Identity();
  const Vec3 force = push.force + k * (b.a + b.alpha.cross(d));
  b.n -= d.cross(force);
  b.f -= force;
}

// From the tips to the root: takes each joint's acceleration out and hands what is left to its
// parent.
void Solver::eliminate() {
  for (int i = tree_.size() - 1; i >= 0; --i) {
    Body& b = body_[i];
    const Mat3 K = b.R * joint_mass_[i] * b.R.transpose();
    const Vec3 t = b.R * torque_[i];
    b.P = (b.A + K).inverse();
    b.PA = b.P * b.A;
    b.PB = b.P * b.B;
    b.x0 = b.P * (t - b.n - b.A * b.zeta);
    const int parent = tree_.segments[i].parent;
    if (parent < 0) continue;
    Body& to = body_[parent];
    const Mat3 A = K * b.PA, B = K * b.PB, M = b.M - b.B.transpose() * b.PB;
    const Mat3 S = skew(to.step), SM = S * M, BS = B * S;
    const Vec3 f = b.f + b.B.transpose() * (b.zeta + b.x0) + M * b.beta;
    to.A += A - BS - BS.transpose() - SM * S;
    to.B += B + SM;
    to.M += M;
    to.n += t - K * b.x0 + B * b.beta + S * f;
    to.f += f;
  }
}

// From the root to the tips: the joint accelerations `x` (W), with them those of the bodies.
void Solver::descend(bool moving) {
  for (int i = 0; i < tree_.size(); ++i) {
    Body& b = body_[i];
    const int parent = tree_.segments[i].parent;
    Vec3 alpha = Vec3::Zero();
    b.a.setZero();
    if (parent >= 0) {
      alpha = body_[parent].alpha;
      b.a = body_[parent].a + alpha.cross(body_[parent].step) + b.beta;
    } else if (moving) {
      alpha = clamp_.alpha;
      b.a = clamp_.a;
    }
    b.x = b.x0 - b.PA * alpha - b.PB * b.a;
    b.alpha = alpha + b.zeta + b.x;
  }
}

void Solver::joint_terms(double gh, bool dynamic) {
  const std::size_t memories = tree_.law.memory.size();
  const double now = around_.clock + time_;
  for (int i = 0; i < tree_.size(); ++i) {
    const Joint& joint = tree_.segments[i].joint;
    JointInput in;
    in.relative = trial_relative_[i];
    in.rate = trial_rate_[i];
    in.settled = settled_[i];
    in.hung = hung_[i];
    in.past = past_[i];
    in.stiffening = 1.0 + tree_.law.drift_rate * now;
    in.stage = dynamic ? gh : 0.0;
    const JointOutput out = evaluate(joint, tree_.law, in, q_known_.data() + i * memories,
                                     trial_q_.data() + i * memories);
    trial_past_[i] = out.past;
    double share = 1.0;
    for (const MemoryTerm& term : tree_.law.memory) share += term.instant;
    const double k = dynamic ? gh * joint.damping_time + gh * gh * share : 1.0;
    joint_mass_[i] = in.stiffening * k * joint.stiffness;
    torque_[i] = out.torque + (dynamic ? Vec3(joint_mass_[i] * accel_[i]) : Vec3::Zero());
  }
}

// The clamp's velocity and acceleration at a stage are those with which the method itself lands on
// its given place.
void Solver::set_clamp(int s, double h) {
  if (!around_.clamp) return;
  const Pose pose = around_.clamp(time_ + stage_time[s] * h);
  const Mat3 R = pose.rotation.toRotationMatrix();
  Vec3 moved = pose * tree_.root - clamp_start_.p;
  Vec3 turned = rotation_log(Quat(Mat3(R * clamp_start_.R.transpose())));
  Vec3 gained = -clamp_start_.v, spun = -clamp_start_.w;
  for (int r = 0; r < s; ++r) {
    moved -= h * tableau[s][r] * clamp_v_[r];
    turned -= h * tableau[s][r] * clamp_w_[r];
    gained -= h * tableau[s][r] * clamp_a_[r];
    spun -= h * tableau[s][r] * clamp_alpha_[r];
  }
  const double gh = gamma_ * h;
  clamp_.R = R;
  clamp_.p = pose * tree_.root;
  clamp_.v = clamp_v_[s] = moved / gh;
  clamp_.w = clamp_w_[s] = turned / gh;
  clamp_.a = clamp_a_[s] = (gained + clamp_.v) / gh;
  clamp_.alpha = clamp_alpha_[s] = (spun + clamp_.w) / gh;
}

void Solver::solve_stage(int s, double h) {
  const int n = tree_.size();
  const double gh = gamma_ * h;
  Stage& stage = stage_[s];
  set_clamp(s, h);
  for (int i = 0; i < n; ++i) {
    stage.theta_known[i].setZero();
    stage.rate_known[i] = rate_[i];
    for (int r = 0; r < s; ++r) {
      stage.theta_known[i] += h * tableau[s][r] * stage_[r].theta_rate[i];
      stage.rate_known[i] += h * tableau[s][r] * stage_[r].accel[i];
    }
  }
  for (std::size_t m = 0; m < q_.size(); ++m) {
    q_known_[m] = q_[m];
    for (int r = 0; r < s; ++r) q_known_[m] += h * tableau[s][r] * stage_[r].q_rate[m];
  }
  const auto take_over = [&] {
    for (int i = 0; i < n; ++i) {
      trial_rate_[i] = stage.rate_known[i] + gh * accel_[i];
      Vec3 theta = stage.theta_known[i] + gh * trial_rate_[i];
      for (int k = 0; k < 2; ++k)
        theta = stage.theta_known[i] + gh * turn_rate(theta, trial_rate_[i]);
      stage.theta_rate[i] = (theta - stage.theta_known[i]) / gh;
      trial_relative_[i] = (relative_[i] * rotation_exp(theta)).normalized();
    }
  };
  for (int k = 0; k < most_iterations; ++k) {
    ++iterations_;
    take_over();
    place_bodies();
    joint_terms(gh, true);
    gather(1.0, gh * gh, time_ + stage_time[s] * h, time_ + 0.5 * h);
    eliminate();
    descend(true);
    double change = 0.0;
    for (int i = 0; i < n; ++i) {
      const Vec3 accel = body_[i].R.transpose() * body_[i].x;
      change = std::max(change, gh * gh * (accel - accel_[i]).cwiseAbs().maxCoeff());
      accel_[i] = accel;
    }
    if (!(change > tolerance)) break;
  }
  take_over();
  stage.accel = accel_;
  for (std::size_t m = 0; m < q_.size(); ++m) stage.q_rate[m] = (trial_q_[m] - q_known_[m]) / gh;
}

void Solver::step(double h) {
  clamp_start_ = clamp_;
  for (int s = 0; s < 3; ++s) solve_stage(s, h);
  relative_ = trial_relative_;
  rate_ = trial_rate_;
  past_ = trial_past_;
  q_ = trial_q_;
  time_ += h;
  place_bodies();
}

Vec3 Solver::position(const Place& place) const {
  const Body& b = body_[place.segment];
  return b.p + b.R.col(2) * place.along;
}

Vec3 Solver::velocity(const Place& place) const {
  const Body& b = body_[place.segment];
  return b.v + b.w.cross(b.R.col(2) * place.along);
}

Eigen::Matrix<double, 6, 1> Solver::root_wrench(double middle) {
  gather(1.0, 0.0, time_, middle);
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Body& b : body_) {
    const Vec3 force = b.M * b.a + b.B.transpose() * b.alpha + b.f;
    sum.head<3>() += force;
    sum.tail<3>() += b.A * b.alpha + b.B * b.a + b.n + (b.p - clamp_.p).cross(force);
  }
  return sum;
}

double Solver::curvature(int segment) const {
  const Joint& joint = tree_.segments[segment].joint;
  return rotation_log(joint.rest.conjugate() * relative_[segment]).head<2>().norm() / joint.length;
}

double Solver::energy() const {
  double sum = 0.0;
  for (int i = 0; i < tree_.size(); ++i) {
    const Segment& s = tree_.segments[i];
    const Body& b = body_[i];
    const Vec3 c = b.R.col(2) * s.centre, w = b.R.transpose() * b.w;
    const Vec3 phi = rotation_log(s.joint.rest.conjugate() * relative_[i]);
    sum += 0.5 * w.dot(s.inertia.asDiagonal() * w) + 0.5 * s.mass * b.v.squaredNorm() +
           s.mass * b.v.dot(b.w.cross(c)) - s.mass * around_.gravity.dot(b.p + c) +
           0.5 * phi.dot(s.joint.stiffness * phi);
  }
  return sum;
}

}  // namespace pedicel::reference
