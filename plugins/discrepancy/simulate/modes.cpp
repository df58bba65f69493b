#include "plugins/discrepancy/simulate/modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "engine/core/random.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/exact_hessian.h"

namespace pedicel::discrepancy {

namespace {

using cosserat::Mat6;
using cosserat::Vec6;

constexpr int spare = 6;    // vectors beyond those that are wanted, which speed the iteration up
constexpr int rounds = 12;  // ratios of stiffness to the power of this are what is left

// Of an element's place and turn: its centre of mass lies com_back before the child node.
Mat6 mass_of(const cosserat::Element& element, const Quat& orientation) {
  const Mat3 turn = orientation.toRotationMatrix();
  const Mat3 arm = element.com_back * skew(Vec3(turn.col(2)));
  Mat6 mass = Mat6::Zero();
  mass.topLeftCorner<3, 3>() = element.mass * Mat3::Identity();
  mass.topRightCorner<3, 3>() = element.mass * arm;
  mass.bottomLeftCorner<3, 3>() = element.mass * arm.transpose();
  mass.bottomRightCorner<3, 3>() =
      element.mass * arm.transpose() * arm + turn * element.inertia.asDiagonal() * turn.transpose();
  return mass;
}

class Masses {
 public:
  Masses(const cosserat::RodModel& model, const cosserat::RodState& state) {
    for (int e = 0; e < model.size(); ++e)
      blocks_.push_back(state.alive[e] ? mass_of(model.elements[e], state.orientation[e])
                                       : Mat6(Mat6::Zero()));
  }
  Eigen::MatrixXd times(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd product(x.rows(), x.cols());
    for (std::size_t e = 0; e < blocks_.size(); ++e)
      product.middleRows<6>(6 * static_cast<Eigen::Index>(e)) =
          blocks_[e] * x.middleRows<6>(6 * static_cast<Eigen::Index>(e));
    return product;
  }

 private:
  std::vector<Mat6> blocks_;
};

// What does not depend on chance, and lies along no mode alone.
Eigen::MatrixXd first_vectors(Eigen::Index rows, Eigen::Index columns) {
  Random random(1);
  Eigen::MatrixXd x(rows, columns);
  for (double& one : x.reshaped()) one = random.normal();
  return x;
}

// Whole columns with a largest node displacement of 1.
void scale(Eigen::MatrixXd& shape) {
  for (Eigen::Index c = 0; c < shape.cols(); ++c) {
    double most = 0.0;
    for (Eigen::Index e = 0; e < shape.rows(); e += 6)
      most = std::max(most, shape.col(c).segment<3>(e).norm());
    shape.col(c) /= std::max(most, 1.0e-300);
  }
}

// Of the whole plant: the mean by mass is what a mode sees where it hardly varies.
void find_decay(const cosserat::RodModel& model, Modes& modes) {
  double mass = 0.0, viscous = 0.0, drag = 0.0;
  for (const cosserat::Element& element : model.elements) {
    mass += element.mass;
    viscous += element.mass * element.damping_time;
    drag += element.mass * element.mass_damping;
  }
  modes.decay = (0.5 * viscous / mass) * modes.frequency.array().square() + 0.5 * drag / mass;
}

}  // namespace

Stiffness::Stiffness(const cosserat::RodModel& model, const cosserat::RodState& state,
                     const Vec3& gravity, std::span<const cosserat::Load> loads,
                     std::span<const Guide> guides)
    : system_(model), elements_(model.size()) {
  system_.clear();
  add_exact_hessian(model, state, gravity, loads, system_);
  for (const Guide& guide : guides) {
    if (!state.alive[guide.element]) continue;
    if (guide.one_sided && force_of(guide, model, state).isZero(0.0)) continue;
    const Vec3 arm = -guide.back * (state.orientation[guide.element] * Vec3::UnitZ());
    const Mat3 spring = guide.stiffness * guide.axis * guide.axis.transpose();
    cosserat::add_point_spring(system_, guide.element, arm, spring, Vec3::Zero());
  }
}

std::optional<Eigen::VectorXd> Stiffness::solve(const Eigen::VectorXd& forces) const {
  cosserat::BlockSystem system = system_;  // its factors take the blocks' place
  for (int e = 0; e < elements_; ++e) system.right_side(e) = forces.segment<6>(6 * e);
  if (!system.solve()) return std::nullopt;
  Eigen::VectorXd moved(6 * elements_);
  for (int e = 0; e < elements_; ++e) moved.segment<6>(6 * e) = system.solution(e);
  return moved;
}

// Subspace iteration with the inverse (Bathe, Finite Element Procedures, section 11.6).
Modes modes_of(const cosserat::RodModel& model, const cosserat::RodState& state,
               const Stiffness& stiffness, int count) {
  const Eigen::Index rows = 6 * static_cast<Eigen::Index>(model.size());
  const Eigen::Index vectors = std::min<Eigen::Index>(count + spare, rows);
  const Masses masses(model, state);
  Eigen::MatrixXd x = first_vectors(rows, vectors);
  Modes modes;
  Eigen::VectorXd stiff;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::MatrixXd pushed = masses.times(x);
    for (Eigen::Index c = 0; c < vectors; ++c) {
      const auto moved = stiffness.solve(pushed.col(c));
      if (!moved) return {};
      x.col(c) = *moved;
    }
    // With x = K^-1 M y, x.K x is x.M y, without K itself.
    const Eigen::MatrixXd elastic = x.transpose() * pushed;
    const Eigen::MatrixXd inert = x.transpose() * masses.times(x);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(
        0.5 * (elastic + elastic.transpose()), inert);
    if (ritz.info() != Eigen::Success) return {};
    x *= ritz.eigenvectors();
    stiff = ritz.eigenvalues();
  }
  const Eigen::Index kept = std::min<Eigen::Index>(count, vectors);
  if (!(stiff[0] > 0.0)) return {};
  modes.frequency = stiff.head(kept).cwiseSqrt();
  modes.shape = x.leftCols(kept);
  scale(modes.shape);
  find_decay(model, modes);
  return modes;
}

}  // namespace pedicel::discrepancy
