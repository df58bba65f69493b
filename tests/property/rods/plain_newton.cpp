// Newton's system of a plain step and its solution; plain_step.cpp has the potential.
#include <Eigen/Dense>
#include <cmath>

#include "tests/property/rods/plain_rotation.h"
#include "tests/property/rods/plain_step.h"

namespace pedicel::plain {

using cosserat::Element;
using Rows3x6 = Eigen::Matrix<double, 3, 6>;

namespace {

const Vec3 along_axis = Vec3::UnitZ();

// A spring between the world and what J moves: K (N/m or N m/rad), its force on it.
void add_spring(System& system, int e, const Rows3x6& j, const Mat3& k, const Vec3& force) {
  system.diagonal[e] += j.transpose() * k * j;
  system.right[e] += j.transpose() * force;
}

Rows3x6 of_position() {
  Rows3x6 j = Rows3x6::Zero();
  j.leftCols<3>().setIdentity();
  return j;
}

// Of a point `arm` (m, W) from the node.
Rows3x6 of_point(const Vec3& arm) {
  Rows3x6 j = of_position();
  j.rightCols<3>() = -skew(arm);
  return j;
}

Rows3x6 of_rotation(const Mat3& by) {
  Rows3x6 j = Rows3x6::Zero();
  j.rightCols<3>() = by;
  return j;
}

}  // namespace

void Step::add_element(int e, const Place& place, System& system) const {
  const Element& element = model_.elements[e];
  const Terms& terms = terms_[e];
  const Strained s = strained(e, place);
  const Mat3 into_E = s.r.transpose();

  // The strain changes with the element's unknowns by J, with its parent's by `of_parent`.
  const auto add_joint = [&](const Rows3x6& j, const Rows3x6& of_parent, const Mat3& k,
                             const Vec3& force) {
    add_spring(system, e, j, k, force);
    const int parent = element.parent;
    if (parent < 0) return;
    add_spring(system, parent, of_parent, k, force);
    system.coupling[e] += j.transpose() * k * of_parent;
  };
  const Vec3 force = terms.stretch_rate.cwiseProduct(s.stretch);  // N, E
  Rows3x6 stretch;
  stretch << into_E / element.length, into_E * skew(s.along);
  add_joint(stretch, -into_E / element.length * of_position(),
            element.length * Mat3(terms.stretch_rate.asDiagonal()), -element.length * force);
  const JointAnswer joint = answer(terms.joint, s.phi);
  const Rows3x6 bend = of_rotation(change_of_vector(s.phi) * into_E);
  add_joint(bend, -bend, joint.stiffness, -joint.moment);

  const Vec3 axis = s.r * along_axis;
  const double tension = std::max(force.z(), 0.0) * element.length;
  system.diagonal[e].bottomRightCorner<3, 3>() +=
      tension * (Mat3::Identity() - axis * axis.transpose());

  const double inertia = terms.inertia_scale * element.mass;
  add_spring(system, e, of_point(-element.com_back * axis), inertia * Mat3::Identity(),
             element.mass * gravity_ - inertia * s.off);
  const Vec3 rotary = terms.inertia_scale * element.inertia;
  system.diagonal[e].bottomRightCorner<3, 3>() += s.r * rotary.asDiagonal() * into_E;
  const Mat3 of_turn =
      (s.from_target.w() * Mat3::Identity() + skew(Vec3(s.from_target.vec()))) * into_E;
  system.right[e].tail<3>() -= of_turn.transpose() * rotary.cwiseProduct(s.turn);
}

void Step::add_drag(int e, const Place& place, System& system) const {
  const double c = terms_[e].drag;
  if (c == 0.0) return;
  const Vec3 axis = place.orientation[e] * along_axis;
  const auto [u, speed] = air_of(e, {place.position[e], place.orientation[e]}, axis);
  const Mat3 across = Mat3::Identity() - axis * axis.transpose();
  Mat3 slope = c / h_ * speed * across;
  if (speed > 1.0e-100) slope += c / h_ * (u * u.transpose() / speed);
  add_spring(system, e, of_point(-0.5 * model_.elements[e].length * axis), slope, c * speed * u);
}

// Loads, supports and welds.
void Step::add_attachments(const Place& place, System& system) const {
  const auto hinge_of = [&](const Quat& rest, int e, const Vec3& k, Mat3& j, Vec3& moment) {
    const Vec3 phi = rotation_vector(rest.conjugate() * place.orientation[e]);
    j = change_of_vector(phi) * place.orientation[e].conjugate().toRotationMatrix();
    moment = -k.cwiseProduct(phi);
  };
  Mat3 j;
  Vec3 moment;
  for (const cosserat::Load& load : loads_) {
    if (!now_.alive[load.element]) continue;
    const Vec3 arm = -load.back * (place.orientation[load.element] * along_axis);
    add_spring(system, load.element, of_point(arm), Mat3::Zero(), load.force_W);
    system.right[load.element].tail<3>() += load.moment_W;
  }
  for (const cosserat::Support& one : model_.supports) {
    if (!now_.alive[one.element]) continue;
    const int e = one.element;
    const Vec3 arm = -one.back * (place.orientation[e] * along_axis);
    add_spring(system, e, of_point(arm), one.position_stiffness * Mat3::Identity(),
               -one.position_stiffness * (place.position[e] + arm - one.position));
    hinge_of(one.rotation, e, one.rotation_stiffness, j, moment);
    add_spring(system, e, of_rotation(j), one.rotation_stiffness.asDiagonal(), moment);
  }
  for (std::size_t w = 0; w < model_.welds.size(); ++w) {
    const cosserat::Weld& one = model_.welds[w];
    if (!now_.alive[one.a] || !now_.alive[one.b]) continue;
    const double k = one.position_stiffness;
    const Vec3 gap = place.position[one.b] - place.position[one.a];
    hinge_of(place.orientation[one.a] * one.rest_rotation, one.b, one.bend_stiffness, j, moment);
    for (const double sign : {-1.0, 1.0}) {
      const int e = sign < 0.0 ? one.a : one.b;
      add_spring(system, e, sign * of_position(), k * Mat3::Identity(), -k * gap);
      add_spring(system, e, sign * of_rotation(j), one.bend_stiffness.asDiagonal(), moment);
    }
    system.weld[w] -= of_position().transpose() * (k * of_position());
    system.weld[w] -= of_rotation(j).transpose() * one.bend_stiffness.asDiagonal() * of_rotation(j);
  }
}

System Step::linearise(const Place& place) const {
  System system(model_);
  for (int e = 0; e < model_.size(); ++e) {
    if (now_.alive[e]) {
      add_element(e, place, system);
      add_drag(e, place, system);
    } else {
      system.diagonal[e].setIdentity();  // it stays where it is
    }
  }
  add_attachments(place, system);
  return system;
}

double Step::potential(const Place& place, const Place& about) const {
  double sum = 0.0;
  for (int e = 0; e < model_.size(); ++e)
    if (now_.alive[e]) sum += potential_of(e, place, about);
  const auto hinge = [&](const Quat& relative, const Vec3& k) {
    const Vec3 phi = rotation_vector(relative);
    return 0.5 * phi.dot(k.cwiseProduct(phi));
  };
  for (const cosserat::Load& load : loads_) {
    const int e = load.element;
    if (!now_.alive[e]) continue;
    const Vec3 point = place.position[e] - load.back * (place.orientation[e] * along_axis);
    sum -=
        load.force_W.dot(point - now_.position[e]) +
        load.moment_W.dot(rotation_vector(place.orientation[e] * about.orientation[e].conjugate()));
  }
  for (const cosserat::Support& one : model_.supports) {
    const int e = one.element;
    if (!now_.alive[e]) continue;
    const Vec3 point = place.position[e] - one.back * (place.orientation[e] * along_axis);
    sum += 0.5 * one.position_stiffness * (point - one.position).squaredNorm() +
           hinge(one.rotation.conjugate() * place.orientation[e], one.rotation_stiffness);
  }
  for (const cosserat::Weld& one : model_.welds) {
    if (!now_.alive[one.a] || !now_.alive[one.b]) continue;
    sum +=
        0.5 * one.position_stiffness *
            (place.position[one.b] - place.position[one.a]).squaredNorm() +
        hinge((place.orientation[one.a] * one.rest_rotation).conjugate() * place.orientation[one.b],
              one.bend_stiffness);
  }
  return sum;
}

std::optional<Place> minimise(const Step& step, const Place& from, double tolerance) {
  Place place = from;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const auto change = solve(step.linearise(place));
    if (!change) return std::nullopt;
    double largest = 0.0;
    for (const Six& one : *change) largest = std::max(largest, one.cwiseAbs().maxCoeff());
    const double before = step.potential(place, place);
    double share = std::min(1.0, 1.0 / std::max(largest, 1.0e-300));
    Place next = moved(place, *change, share);
    while (largest > 1.0e-4 && step.potential(next, place) > before && share > 1.0e-4) {
      share *= 0.5;
      next = moved(place, *change, share);
    }
    place = next;
    if (largest <= tolerance) return place;
  }
  return std::nullopt;
}

}  // namespace pedicel::plain
