#include "plugins/cosserat/solver/attachments.h"

#include <algorithm>

#include "plugins/cosserat/model/rotation.h"

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

// A string that pulls, between two points.
struct Pull {
  double stretch = 0.0;         // m, <= 0: it is slack
  Vec3 along = Vec3::Zero();    // unit, W, from the first point to the second
  double force = 0.0;           // N
  Mat3 hessian = Mat3::Zero();  // N/m, W
};

// Along the string its stiffness, across it that of a taut string, tension over length: both are
// positive, so that the Hessian is exact and positive semidefinite.
Pull pull_between(const Vec3& from, const Vec3& to, double length, double stiffness) {
  Pull pull;
  const Vec3 way = to - from;
  const double distance = way.norm();
  pull.stretch = distance - length;
  // Two ends in one place pull nowhere.
  if (pull.stretch <= 0.0 || distance == 0.0) return {};
  pull.along = way / distance;
  pull.force = stiffness * pull.stretch;
  const Mat3 projector = pull.along * pull.along.transpose();
  pull.hessian = stiffness * projector + pull.force / distance * (Mat3::Identity() - projector);
  return pull;
}

Vec3 arm_of(const RodState& state, int element, double back) {
  return -back * (state.orientation[element] * Vec3::UnitZ());
}

Pull pull_of(const RodState& state, const Strand& strand) {
  return pull_between(state.position[strand.a] + arm_of(state, strand.a, strand.back_a),
                      state.position[strand.b] + arm_of(state, strand.b, strand.back_b),
                      strand.length, strand.stiffness);
}

bool holds(const RodState& state, const Strand& strand) {
  return state.alive[strand.a] && state.alive[strand.b];
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
  for (const Strand& one : model.strands)
    if (holds(state, one)) energy += strand(state, one, blocks);
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

double Attachments::tie(const RodState& state, const Tie& tie, DiagonalBlocks* blocks) const {
  const int e = tie.element;
  const Vec3 arm = arm_of(state, e, tie.back);
  const Pull pull = pull_between(state.position[e] + arm, tie.anchor_W, tie.length, tie.stiffness);
  if (pull.stretch <= 0.0) return 0.0;
  if (blocks) add_point_spring(*blocks, e, arm, pull.hessian, pull.force * pull.along);
  return 0.5 * tie.stiffness * pull.stretch * pull.stretch;
}

// Both ends get the one force.
double Attachments::strand(const RodState& state, const Strand& strand,
                           DiagonalBlocks* blocks) const {
  const Pull pull = pull_of(state, strand);
  if (pull.stretch <= 0.0) return 0.0;
  if (blocks) {
    const Vec3 force = pull.force * pull.along;
    add_point_spring(*blocks, strand.a, arm_of(state, strand.a, strand.back_a), pull.hessian,
                     force);
    add_point_spring(*blocks, strand.b, arm_of(state, strand.b, strand.back_b), pull.hessian,
                     -force);
  }
  return 0.5 * strand.stiffness * pull.stretch * pull.stretch;
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

// The stretch is of the way from a to b, so what one end gives to the other has the other sign.
Mat6 strand_coupling(const RodState& state, const Strand& strand) {
  Mat6 block = Mat6::Zero();
  if (!holds(state, strand)) return block;
  const Mat3 hessian = pull_of(state, strand).hessian;
  const Mat3 lever_a = -skew(arm_of(state, strand.a, strand.back_a));  // d point / d rotation
  const Mat3 lever_b = -skew(arm_of(state, strand.b, strand.back_b));
  block.topLeftCorner<3, 3>() = -hessian;
  block.topRightCorner<3, 3>() = -hessian * lever_a;
  block.bottomLeftCorner<3, 3>() = -lever_b.transpose() * hessian;
  block.bottomRightCorner<3, 3>() = -lever_b.transpose() * hessian * lever_a;
  return block;
}

}  // namespace pedicel::cosserat
