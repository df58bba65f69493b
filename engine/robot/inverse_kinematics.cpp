#include "engine/robot/inverse_kinematics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/random.h"
#include "engine/io/csv.h"

namespace pedicel::robot {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Eigen::VectorXd;

/// The rotation vector that turns unit vector `from` into `to`, perpendicular to both.
Vec3 turn_between(const Vec3& from, const Vec3& to) {
  const Vec3 cross = from.cross(to);
  const double angle = std::atan2(cross.norm(), from.dot(to));
  const Vec3 axis = cross.norm() > 1e-12 ? Vec3(cross.normalized()) : from.unitOrthogonal();
  return angle * axis;
}

Vec3 rotation_error(const Pose& pose, const IkTarget& target) {
  if (target.orientation_W) {
    const Eigen::AngleAxisd turn(*target.orientation_W * pose.rotation.conjugate());
    const double angle = std::remainder(turn.angle(), 2.0 * std::numbers::pi);
    return angle * turn.axis();
  }
  if (target.approach_W)
    return turn_between(pose.rotation * Vec3::UnitZ(), target.approach_W->normalized());
  return Vec3::Zero();
}

bool is_free(const KinematicModel& model, int link, const IkSettings& settings, int dof) {
  const auto& held = settings.held;
  return model.moves(dof, link) && std::find(held.begin(), held.end(), dof) == held.end();
}

/// One descent's work space.
class Descent {
 public:
  Descent(const KinematicModel& model, const IkTarget& target, const IkSettings& settings,
          const VectorXd& q_start)
      : model_(model), target_(target), settings_(settings), q_(model.clamped(q_start)) {
    for (int held : settings.held) q_[held] = q_start[held];
    for (int i = 0; i < model.dofs(); ++i)
      if (is_free(model, target.link, settings, i)) free_.push_back(i);
  }

  IkResult run() {
    error_ = error_at(q_, pose_);
    double damping = 1e-4;
    for (int i = 0; i < settings_.iterations && !reached() && damping < 1e8; ++i)
      damping = improve(damping) ? std::max(0.2 * damping, 1e-12) : 8.0 * damping;
    const auto [position, rotation] = ik_error(pose_, target_);
    return {q_, reached(), position, rotation, {}};
  }

 private:
  Vec6 error_at(const VectorXd& q, Pose& pose) {
    model_.link_poses(q, poses_);
    pose = poses_[target_.link];
    Vec6 error;
    error << target_.position_W - pose.position,
        settings_.radian_length * rotation_error(pose, target_);
    return error;
  }

  bool reached() const {
    const auto [position, rotation] = ik_error(pose_, target_);
    return position <= settings_.position_tolerance && rotation <= settings_.rotation_tolerance;
  }

  /// The Jacobian of the error's rows, with turns that do not count taken out.
  Jacobian weighted_jacobian() {
    model_.link_poses(q_, poses_);
    Jacobian j;
    model_.jacobian(poses_, target_.link, Vec3::Zero(), j);
    if (target_.orientation_W) {
      j.bottomRows<3>() *= settings_.radian_length;
    } else if (target_.approach_W) {
      const Vec3 z = pose_.rotation * Vec3::UnitZ();
      const Mat3 across = Mat3::Identity() - z * z.transpose();
      j.bottomRows<3>() = settings_.radian_length * across * j.bottomRows<3>();
    } else {
      j.bottomRows<3>().setZero();
    }
    return j;
  }

  /// Joints that may move: not those at a limit whose gradient pushes them against it.
  std::vector<int> movable(const VectorXd& gradient) const {
    std::vector<int> result;
    for (int i : free_) {
      const bool stuck = (q_[i] <= model_.lower()[i] && gradient[i] < 0.0) ||
                         (q_[i] >= model_.upper()[i] && gradient[i] > 0.0);
      if (!stuck) result.push_back(i);
    }
    return result;
  }

  bool improve(double damping) {
    const Jacobian j = weighted_jacobian();
    const VectorXd gradient = j.transpose() * error_;
    const std::vector<int> moving = movable(gradient);
    if (moving.empty()) return false;
    const Jacobian part = j(Eigen::all, moving);
    Eigen::MatrixXd normal = part.transpose() * part;
    normal.diagonal().array() += damping * std::max(error_.norm(), 1e-6);
    VectorXd step = normal.ldlt().solve(gradient(moving));
    // Half a radian or half a metre at most: beyond it the linear picture means nothing.
    step *= std::min(1.0, 0.5 / std::max(step.cwiseAbs().maxCoeff(), 1e-12));
    VectorXd q = q_;
    q(moving) += step;
    q = model_.clamped(q);
    for (int held : settings_.held) q[held] = q_[held];
    Pose pose;
    const Vec6 error = error_at(q, pose);
    if (error.squaredNorm() >= error_.squaredNorm()) return false;
    q_ = q;
    pose_ = pose;
    error_ = error;
    return true;
  }

  const KinematicModel& model_;
  const IkTarget& target_;
  const IkSettings& settings_;
  VectorXd q_;
  std::vector<int> free_;
  std::vector<Pose> poses_;
  Pose pose_;
  Vec6 error_;
};

VectorXd random_start(const KinematicModel& model, int link, const VectorXd& q_start,
                      const IkSettings& settings, Random& random) {
  constexpr double pi = std::numbers::pi;
  VectorXd q = q_start;
  for (int i = 0; i < model.dofs(); ++i) {
    const double draw = random.uniform();  // for every joint: same seed, same starts
    if (!is_free(model, link, settings, i)) continue;
    const double low = std::max(model.lower()[i], -pi), high = std::min(model.upper()[i], pi);
    q[i] = low <= high ? low + draw * (high - low) : model.clamped(q_start)[i];
  }
  return q;
}

/// The same pose with every joint as few turns away from `q_start` as its limits allow.
VectorXd unwound(const KinematicModel& model, VectorXd q, const VectorXd& q_start) {
  constexpr double turn = 2.0 * std::numbers::pi;
  for (int i = 0; i < model.dofs(); ++i) {
    if (!model.periodic(i)) continue;
    const double near = q[i] + turn * std::round((q_start[i] - q[i]) / turn);
    for (const double candidate : {near, near < q_start[i] ? near + turn : near - turn})
      if (candidate >= model.lower()[i] && candidate <= model.upper()[i]) {
        q[i] = candidate;
        break;
      }
  }
  return q;
}

double weight(const IkResult& result, const IkSettings& settings) {
  return std::hypot(result.position_error, settings.radian_length * result.rotation_error);
}

IkResult best_of_restarts(const KinematicModel& model, const IkTarget& target,
                          const VectorXd& q_start, const IkSettings& settings) {
  Random random(settings.seed);
  const IkResult first = descend(model, target, q_start, settings);
  IkResult best = first;
  for (int i = 0; i < settings.restarts && !best.reached; ++i) {
    IkResult next = descend(model, target,
                            random_start(model, target.link, q_start, settings, random), settings);
    if (weight(next, settings) < weight(best, settings)) best = std::move(next);
  }
  if (!best.reached &&
      weight(first, settings) <= (1.0 + settings.start_preference) * weight(best, settings))
    best = first;
  best.q = unwound(model, best.q, q_start);
  return best;
}

std::string distance_text(double metres) {
  if (metres >= 1.0) return io::format_number(metres, 3) + " m";
  return io::format_number(metres * 1e3, metres < 0.1 ? 2 : 3) + " mm";
}

}  // namespace

std::pair<double, double> ik_error(const Pose& pose, const IkTarget& target) {
  return {(target.position_W - pose.position).norm(), rotation_error(pose, target).norm()};
}

IkResult descend(const KinematicModel& model, const IkTarget& target, const VectorXd& q_start,
                 const IkSettings& settings) {
  return Descent(model, target, settings, q_start).run();
}

IkResult inverse_kinematics(const KinematicModel& model, const IkTarget& target,
                            const VectorXd& q_start, const IkSettings& settings) {
  IkResult best = best_of_restarts(model, target, q_start, settings);
  if (best.reached) return best;
  IkTarget point = target;
  point.orientation_W.reset();
  point.approach_W.reset();
  const IkResult nearest = best_of_restarts(model, point, best.q, settings);
  if (!nearest.reached)
    best.sentence = "unreachable: nearest reachable point is " +
                    distance_text(nearest.position_error) + " away";
  else
    best.sentence = "unreachable in this orientation: nearest reachable pose is " +
                    distance_text(best.position_error) + " and " +
                    io::format_number(best.rotation_error * 180.0 / std::numbers::pi, 2) +
                    " degrees away";
  return best;
}

std::vector<VectorXd> ik_solutions(const KinematicModel& model, const IkTarget& target,
                                   const VectorXd& q_start, const IkSettings& settings) {
  Random random(settings.seed);
  std::vector<VectorXd> found;
  for (int i = 0; i <= settings.restarts; ++i) {
    const VectorXd start =
        i == 0 ? q_start : random_start(model, target.link, q_start, settings, random);
    IkResult result = descend(model, target, start, settings);
    if (!result.reached) continue;
    result.q = unwound(model, result.q, q_start);
    const bool known = std::any_of(found.begin(), found.end(), [&](const VectorXd& q) {
      return (q - result.q).cwiseAbs().maxCoeff() < 1e-2;
    });
    if (!known) found.push_back(result.q);
  }
  std::stable_sort(found.begin(), found.end(), [&](const VectorXd& a, const VectorXd& b) {
    return (a - q_start).squaredNorm() < (b - q_start).squaredNorm();
  });
  return found;
}

}  // namespace pedicel::robot
