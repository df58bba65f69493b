#include "tests/discrepancy/reference_joint.h"

#include <algorithm>
#include <cmath>

#include "tests/discrepancy/reference_rotation.h"

namespace pedicel::reference {

namespace {

// Moves `permanent` (rad, bending) so that `strain` - permanent is at most `limit` long.
void give_way(const Vec3& strain, double limit, Vec3& permanent) {
  const Eigen::Vector2d elastic = (strain - permanent).head<2>();
  const double size = elastic.norm();
  if (size > limit) permanent.head<2>() += (1.0 - limit / size) * elastic;
}

// Where a slider of stiffness `share` K starts to slip, rad.
double slip_limit(const Joint& joint, const JointLaw& law, const Vec3& stretch, double stiffening) {
  double limit = law.slider_curvature * joint.length;
  if (std::isfinite(law.slider_moment)) {
    const double size = stretch.head<2>().norm();
    const double moment = stiffening * law.slider_ratio *
                          (joint.stiffness.topLeftCorner<2, 2>() * stretch.head<2>()).norm();
    if (moment > 0) limit = std::min(limit, law.slider_moment / moment * size);
  }
  return limit;
}

// Bouc-Wen's z over K after a joint has turned by `turn` (rad, bending), by Heun's method: along z
// dz = dphi - |z/reach|^exponent |dphi|, across it dz = dphi.
Vec3 wind(Vec3 wound, const Vec3& turn, double reach, double exponent) {
  constexpr int parts = 40;
  Eigen::Vector2d z = wound.head<2>();
  const Eigen::Vector2d d = turn.head<2>() / parts;
  const auto change = [&](const Eigen::Vector2d& at) -> Eigen::Vector2d {
    const double size = at.norm();
    if (size < 1e-15) return d;
    return d - std::pow(size / reach, exponent) * std::abs(d.dot(at / size)) * (at / size);
  };
  for (int i = 0; i < parts; ++i) {
    const Eigen::Vector2d first = change(z);
    z += 0.5 * (first + change(z + first));
  }
  wound.head<2>() = z;
  return wound;
}

}  // namespace

JointOutput evaluate(const Joint& joint, const JointLaw& law, const JointInput& in,
                     const Vec3* q_known, Vec3* q) {
  JointOutput out;
  out.past = in.past;
  out.phi = rotation_log((joint.rest.conjugate() * in.relative).normalized());
  const Mat3 tangent = inverse_tangent(out.phi);
  if (std::isfinite(law.yield_curvature))
    give_way(out.phi, law.yield_curvature * joint.length, out.past.plastic);
  Vec3 strain = out.phi - out.past.plastic;  // what the springs see
  if (law.nonlinearity != 0.0) {
    const double k = strain.head<2>().norm() / joint.length / law.k0;
    strain.head<2>() *= 1.0 + law.nonlinearity * k * k;
  }
  if (law.asymmetry != 0.0) {
    const Eigen::Vector2d side = joint.side.head<2>();
    const double k = side.dot(out.phi.head<2>()) / joint.length;
    strain.head<2>() += law.asymmetry * k * k / std::hypot(law.side_k0, k) * joint.length * side;
  }
  if (law.slider_ratio > 0.0) {
    const Vec3 moved = out.phi - in.settled;
    if (in.stage > 0.0) {
      const Vec3 stretch = moved - in.past.slip;
      give_way(moved, slip_limit(joint, law, stretch, in.stiffening), out.past.slip);
    }
    Vec3 slider = in.stage > 0.0 ? Vec3(moved - out.past.slip) : Vec3::Zero();
    const Vec3 elastic = out.phi - out.past.plastic;
    strain.head<2>() += law.slider_ratio * (slider - elastic).head<2>();
  }
  if (law.hysteresis_ratio > 0.0) {
    const double softer = std::min(joint.stiffness(0, 0), joint.stiffness(1, 1));
    out.past.moved = out.phi - in.settled;
    if (in.stage > 0.0)
      out.past.wound = wind(in.past.wound, out.past.moved - in.past.moved,
                            law.hysteresis_moment / softer, law.hysteresis_exponent);
    strain.head<2>() += law.hysteresis_ratio * (out.past.wound - out.phi).head<2>();
  }
  for (std::size_t m = 0; m < law.memory.size(); ++m) {
    const MemoryTerm& term = law.memory[m];
    if (in.stage <= 0.0) {
      if (term.hung) strain -= term.share * in.hung;
      continue;
    }
    const Vec3 moved = term.hung ? out.phi : Vec3(out.phi - in.settled);
    q[m] = (q_known[m] + in.stage / term.time * moved) / (1.0 + in.stage / term.time);
    strain += term.instant * moved - term.share * q[m];
  }
  strain += joint.damping_time * (tangent * in.rate);
  out.torque = -in.stiffening * (tangent.transpose() * (joint.stiffness * strain));
  return out;
}

}  // namespace pedicel::reference
