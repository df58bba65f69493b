#include <Eigen/Dense>
#include <deque>

#include "tests/discrepancy/reference_rotation.h"
#include "tests/discrepancy/reference_solver.h"

namespace pedicel::reference {

namespace {

/// D. G. Anderson's mixing (J. ACM 12, 1965) of a fixed-point iteration.
class Mixing {
 public:
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& gained) {
    if (last_x_.size()) {
      dx_.push_back(x - last_x_);
      df_.push_back(gained - last_f_);
      if (dx_.size() > depth) dx_.pop_front(), df_.pop_front();
    }
    last_x_ = x;
    last_f_ = gained;
    if (dx_.empty()) return x + gained;
    Eigen::MatrixXd F(x.size(), static_cast<int>(df_.size())), X = F;
    for (int k = 0; k < F.cols(); ++k) {
      F.col(k) = df_[k];
      X.col(k) = dx_[k];
    }
    const Eigen::VectorXd weight = F.colPivHouseholderQr().solve(gained);
    return x + gained - (X + F) * weight;
  }

 private:
  static constexpr std::size_t depth = 12;
  Eigen::VectorXd last_x_, last_f_;
  std::deque<Eigen::VectorXd> dx_, df_;
};

}  // namespace

// Joint rotations from the start as unknowns; one sweep solves the joints' and the springs' linear
// stiffness for what is out of balance, and what that leaves out (the weight's own stiffness) is
// left to the mixing.
bool Solver::settle() {
  const int n = tree_.size();
  const std::vector<Quat> start = relative_;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * n), gained = u;
  Mixing mixing;
  bool settled = false;
  for (auto* v : {&rate_, &trial_rate_, &accel_}) v->assign(n, Vec3::Zero());
  for (int k = 0; k < 2000 && !settled; ++k) {
    for (int i = 0; i < n; ++i)
      trial_relative_[i] = (start[i] * rotation_exp(u.segment<3>(3 * i))).normalized();
    place_bodies();
    for (Body& b : body_) b.a.setZero(), b.alpha.setZero();
    joint_terms(0.0, false);
    gather(1e-3, 1.0, 0.0, 0.0);
    eliminate();
    descend(false);
    for (int i = 0; i < n; ++i) {
      const Vec3 turn = body_[i].R.transpose() * body_[i].x;
      gained.segment<3>(3 * i) =
          rotation_log(start[i].conjugate() * trial_relative_[i] * rotation_exp(turn)) -
          u.segment<3>(3 * i);
    }
    settled = gained.cwiseAbs().maxCoeff() < 1e-11;
    if (!settled) u = mixing.next(u, gained);
  }
  relative_ = trial_relative_;
  past_ = trial_past_;
  for (int i = 0; i < n; ++i)
    settled_[i] = rotation_log(tree_.segments[i].joint.rest.conjugate() * relative_[i]);
  for (JointPast& past : past_) past.moved.setZero();
  place_bodies();
  return settled;
}

}  // namespace pedicel::reference
