#include "pedicel/cosserat/solver/attachments.h"

#include <algorithm>

#include "pedicel/cosserat/model/rotation.h"

namespace pedicel::cosserat {

namespace {

// One rotational spring between two frames (or a frame and the world): its moment on the second.
struct Hinge {
  Mat3 hessian;   // N m/rad, W
  Vec3 moment;    // N m, W: on the second frame
  double energy;  // J
};

Hinge hinge(const Quat& relative_to_rest, const Quat& second, const Vec3& stiffness) {
  const Vec3 phi = log_map(relative_to_rest);
  const Vec3 conjugate = stiffness.cwiseProduct(phi);
  const Mat3 b = inverse_right_jacobian(phi) * second.toRotationMatrix().transpose();
  const Mat3 scaled = stiffness.asDiagonal() * b;
  return {b.transpose() * scaled, -(b.transpose() * conjugate), 0.5 * phi.dot(conjugate)};
}

Hinge hinge_of(const RodState& state, const Weld& weld) {
  const Quat relative = state.orientation[weld.a].conjugate() * state.orientation[weld.b];
  return hinge(weld.rest_rotation.conjugate() * relative, state.orientation[weld.b],
               weld.bend_stiffness);
}

}  // namespace

double tension(const RodState& state, const Tie& tie) {
  if (!state.alive[tie.element]) return 0.0;
  const Vec3 place =
      state.position[tie.element] - tie.back * (state.orientation[tie.element] * Vec3::UnitZ());
  return tie.stiffness * std::max(0.0, (tie.anchor_W - place).norm() - tie.length);
}

void Attachments::prepare(const RodState& start, std::span<const Load> loads,
                          std::span<const Tie> ties) {
  start_ = &start;
  loads_ = loads;
  ties_ = ties;
  refer_moments_to(start);
}

void Attachments::refer_moments_to(const RodState& state) {
  moment_reference_.clear();
  for (const Load& one : loads_) moment_reference_.push_back(state.orientation[one.element]);
}

double Attachments::linearise(const RodModel& model, const RodState& state,
                              DiagonalBlocks& blocks) {
  refer_moments_to(state);
  return sum(model, state, &blocks);
}

double Attachments::potential(const RodModel& model, const RodState& state) const {
  return sum(model, state, nullptr);
}

double Attachments::sum(const RodModel& model, const RodState& state,
                        DiagonalBlocks* blocks) const {
  double energy = 0.0;
  for (int i = 0; i < static_cast<int>(loads_.size()); ++i)
    if (state.alive[loads_[i].element]) energy += load(state, i, blocks);
  for (const Tie& one : ties_)
    if (state.alive[one.element]) energy += tie(state, one, blocks);
  for (const Support& one : model.supports)
    if (state.alive[one.element]) energy += support(state, one, blocks);
  if (!welds_) return energy;
  for (const Weld& one : model.welds)
    if (state.alive[one.a] && state.alive[one.b]) energy += weld(state, one, blocks);
  return energy;
}

double Attachments::load(const RodState& state, int index, DiagonalBlocks* blocks) const {
  const Load& load = loads_[index];
  const int e = load.element;
  const Vec3 arm = -load.back * (state.orientation[e] * Vec3::UnitZ());
  if (blocks) {
    blocks->right_side(e).head<3>() += load.force_W;
    blocks->right_side(e).tail<3>() += arm.cross(load.force_W) + load.moment_W;
  }
  const Vec3 turned = log_map(state.orientation[e] * moment_reference_[index].conjugate());
  return -load.force_W.dot(state.position[e] + arm - start_->position[e]) -
         load.moment_W.dot(turned);
}

// Along the string its stiffness, across it that of a taut string, tension over length: both are
// positive, so that the Hessian is exact and positive semidefinite.
double Attachments::tie(const RodState& state, const Tie& tie, DiagonalBlocks* blocks) const {
  const int e = tie.element;
  const Vec3 arm = -tie.back * (state.orientation[e] * Vec3::UnitZ());
  const Vec3 way = tie.anchor_W - (state.position[e] + arm);
  const double distance = way.norm(), stretch = distance - tie.length;
  if (stretch <= 0.0) return 0.0;
  if (blocks) {
    const Vec3 along = way / distance;
    const double pull = tie.stiffness * stretch;
    const Mat3 projector = along * along.transpose();
    add_point_spring(*blocks, e, arm,
                     tie.stiffness * projector + pull / distance * (Mat3::Identity() - projector),
                     pull * along);
  }
  return 0.5 * tie.stiffness * stretch * stretch;
}

double Attachments::support(const RodState& state, const Support& support,
                            DiagonalBlocks* blocks) const {
  const int e = support.element;
  const Vec3 arm = -support.back * (state.orientation[e] * Vec3::UnitZ());
  const Vec3 off = state.position[e] + arm - support.position;
  const double k = support.position_stiffness;
  const Hinge spring = hinge(support.rotation.conjugate() * state.orientation[e],
                             state.orientation[e], support.rotation_stiffness);
  if (blocks) {
    add_point_spring(*blocks, e, arm, k * Mat3::Identity(), -k * off);
    blocks->diagonal(e).bottomRightCorner<3, 3>() += spring.hessian;
    blocks->right_side(e).tail<3>() += spring.moment;
  }
  return 0.5 * k * off.squaredNorm() + spring.energy;
}

double Attachments::weld(const RodState& state, const Weld& weld, DiagonalBlocks* blocks) const {
  const Vec3 gap = state.position[weld.b] - state.position[weld.a];
  const double k = weld.position_stiffness;
  const Hinge spring = hinge_of(state, weld);
  if (blocks) {
    for (const int e : {weld.a, weld.b}) {
      const double sign = e == weld.a ? -1.0 : 1.0;
      blocks->diagonal(e).topLeftCorner<3, 3>().diagonal().array() += k;
      blocks->diagonal(e).bottomRightCorner<3, 3>() += spring.hessian;
      blocks->right_side(e).head<3>() -= sign * k * gap;
      blocks->right_side(e).tail<3>() += sign * spring.moment;
    }
  }
  return 0.5 * k * gap.squaredNorm() + spring.energy;
}

Mat6 weld_coupling(const RodState& state, const Weld& weld) {
  Mat6 block = Mat6::Zero();
  if (!state.alive[weld.a] || !state.alive[weld.b]) return block;
  block.topLeftCorner<3, 3>() = -weld.position_stiffness * Mat3::Identity();
  block.bottomRightCorner<3, 3>() = -hinge_of(state, weld).hessian;
  return block;
}

}  // namespace pedicel::cosserat
