#include "tests/property/rods/plain_joint.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "plugins/cosserat/laws/joint_terms.h"

namespace pedicel::plain {

namespace {

using cosserat::JointBranch;
using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

// psi(u) of a bending spring with the energy min(K1, K2) psi, u = y.K y / min(K1, K2), and its
// first two derivatives times 2 and 4.
struct Curve {
  double psi, g, slope;
};

Curve hardening_curve(double b, double u) {
  if (b >= 0.0 || u <= -1.0 / (3.0 * b)) return {0.5 * u + 0.25 * b * u * u, 1.0 + b * u, 2.0 * b};
  // The moment, sqrt(u) (1 + b u), stays at its peak.
  const double peak = -1.0 / (3.0 * b), at_peak = 0.5 * peak + 0.25 * b * peak * peak;
  const double moment = 2.0 / 3.0 * std::sqrt(peak), bend = std::sqrt(u);
  return {at_peak + moment * (bend - std::sqrt(peak)), moment / bend, -moment / (bend * u)};
}

double hardening_of(const cosserat::JointLaw& law) {
  return law.terms.empty() ? 0.0 : law.terms[laws::first_number("material_nonlinearity")];
}

Curve slider_curve(double reach, double u) {
  const double bend = std::sqrt(u);
  if (bend <= reach) return {0.5 * u, 1.0, 0.0};
  return {reach * bend - 0.5 * reach * reach, reach / bend, -reach / (bend * u)};
}

bool slides(const JointBranch& branch) {
  return std::isfinite(branch.limit);
}

double softer(const Vec3& k) {
  return std::max(std::min(k.x(), k.y()), 1.0e-300);
}

double measure(const Vec3& k, const Vec2& y) {
  return y.dot(k.head<2>().cwiseProduct(y)) / softer(k);
}

double reach_of(const JointBranch& branch, const Vec3& k) {
  return branch.limit / (branch.share * softer(k) + 1.0e-300);
}

// A dashpot's z at the end is `past` + (1 - factor) phi for a phi that changes evenly.
struct Dashpot {
  double decay, factor;
  Vec3 past;
  Dashpot(const JointBranch& branch, const Vec3& z, const Vec3& now, double dt) {
    const double x = dt / branch.time;
    decay = std::exp(-x);
    factor = x > 0.0 ? -std::expm1(-x) / x : 1.0;
    past = decay * z + (factor - decay) * now;
  }
};

// Energy, moment and stiffness of what is linear in phi: the spring, its damping, the dashpots.
void add_linear(const JointStep& joint, const Vec3& phi, JointAnswer& out) {
  const Vec3& k = joint.stiffness;
  Vec3 share = joint.stiffening * Vec3::Ones();
  Vec3 offset = joint.stiffening * joint.target;  // share * phi - offset is what K multiplies
  if (joint.law) {
    const cosserat::JointLaw& law = *joint.law;
    share.array() += law.elastic + law.deviation - 1.0;
    offset -= joint.bias;
    for (std::size_t j = 0; j < law.branches.size(); ++j) {
      const JointBranch& branch = law.branches[j];
      if (slides(branch)) {
        share.z() += branch.share;  // twist has no slider
        continue;
      }
      const Dashpot dashpot(branch, joint.memory[j], joint.now, joint.dt);
      share.array() += branch.share * dashpot.factor;
      offset += branch.share * dashpot.past;
    }
  }
  out.moment += k.cwiseProduct(share.cwiseProduct(phi) - offset);
  out.energy +=
      0.5 * phi.dot(k.cwiseProduct(share.cwiseProduct(phi))) - offset.dot(k.cwiseProduct(phi));
  out.stiffness.diagonal() += k.cwiseProduct(share);
}

// Adds share times a radial spring that is bent by `y`; `curved` gets what its tangent has beyond
// the secant stiffness.
void add_radial(const Vec3& k, double share, const Vec2& y, const Curve& curve, JointAnswer& out,
                Mat2& curved) {
  const Vec2 elastic = k.head<2>().cwiseProduct(y);
  out.moment.head<2>() += share * curve.g * elastic;
  out.energy += share * softer(k) * curve.psi;
  out.stiffness.diagonal().head<2>() += share * curve.g * k.head<2>();
  curved += share * curve.slope / softer(k) * elastic * elastic.transpose();
}

// asymmetry (plugins/effects): W = K c F(x), x = a.phi, F' = x^2 / sqrt(p^2 + x^2), K the stiffness
// of a joint that is bent about a alone.
void add_asymmetry(const Vec3& k, const cosserat::JointLaw& law, const Vec3& phi, JointAnswer& out,
                   Mat2& curved) {
  const int first = laws::first_number("asymmetry");
  if (law.terms.empty() || law.terms[first] == 0.0) return;
  const double c = law.terms[first], p = law.terms[first + 3];
  const Vec2 a(law.terms[first + 1], law.terms[first + 2]);
  if (a.isZero(0.0)) return;
  const Vec2 along = a.normalized();
  const double about = 1.0 / along.dot(along.cwiseQuotient(k.head<2>()));
  const double size = law.elastic * about * c, x = a.dot(phi.head<2>()), s = std::hypot(p, x);
  out.energy += 0.5 * size * (x * s - p * p * std::asinh(x / p));
  out.moment.head<2>() += size * x * x / s * a;
  const double slope = size * (2.0 * x / s - std::pow(x / s, 3));
  // The steepest slope bounds the energy; the tangent has less.
  const double most = 1.0887 * std::abs(size) * a.squaredNorm();
  out.stiffness.diagonal().head<2>().array() += most;
  curved += slope * a * a.transpose() - most * Mat2::Identity();
}

}  // namespace

JointAnswer answer(const JointStep& joint, const Vec3& phi) {
  JointAnswer out;
  add_linear(joint, phi, out);
  if (!joint.law) return out;
  const Vec3& k = joint.stiffness;
  Mat2 curved = Mat2::Zero();
  Curve beyond = hardening_curve(hardening_of(*joint.law), measure(k, phi.head<2>()));
  beyond.g -= 1.0;  // what is linear of it is there
  beyond.psi -= 0.5 * measure(k, phi.head<2>());
  add_radial(k, joint.law->elastic, phi.head<2>(), beyond, out, curved);
  for (std::size_t j = 0; j < joint.law->branches.size(); ++j) {
    const JointBranch& branch = joint.law->branches[j];
    if (!slides(branch)) continue;
    const Vec2 y = (phi - joint.memory[j]).head<2>();
    add_radial(k, branch.share, y, slider_curve(reach_of(branch, k), measure(k, y)), out, curved);
  }
  add_asymmetry(k, *joint.law, phi, out, curved);
  // Newton takes the tangent where it is positive definite, else the secant.
  auto bending = out.stiffness.topLeftCorner<2, 2>();
  bending.diagonal() = bending.diagonal().cwiseMax(1.0e-4 * k.head<2>());
  const Mat2 tangent = bending + curved;
  if (tangent(0, 0) > 0.0 && tangent.determinant() > 1.0e-4 * bending(0, 0) * bending(1, 1))
    bending = tangent;
  return out;
}

std::vector<Vec3> memory_after(const JointStep& joint, const Vec3& phi) {
  std::vector<Vec3> after(joint.memory.begin(), joint.memory.end());
  if (!joint.law) return after;
  for (std::size_t j = 0; j < joint.law->branches.size(); ++j) {
    const JointBranch& branch = joint.law->branches[j];
    if (!slides(branch)) {
      const Dashpot dashpot(branch, joint.memory[j], joint.now, joint.dt);
      after[j] = dashpot.past + (1.0 - dashpot.factor) * phi;
      continue;
    }
    const Vec2 y = (phi - joint.memory[j]).head<2>();
    const double g = slider_curve(reach_of(branch, joint.stiffness), measure(joint.stiffness, y)).g;
    after[j].head<2>() += (1.0 - g) * y;
  }
  return after;
}

}  // namespace pedicel::plain
