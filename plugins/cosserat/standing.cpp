#include "cosserat/standing.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>

#include "cosserat/block_system.h"
#include "cosserat/rotation.h"

namespace pedicel::cosserat {

namespace {

constexpr double largest_bend = 2.5;  // rad: nearer to pi the rotation vector is no longer unique

// Force and moment that every joint carries, W; one entry an element.
using Loads = std::vector<Vec6>;

// Statics of a tree, leaves first: each joint carries what acts beyond it. `outer` holds the outer
// force and the outer moment about the child node of each element.
Loads carried(const RodModel& model, const Loads& outer) {
  Loads loads = outer;
  for (int e = model.size() - 1; e >= 0; --e) {
    const Vec3 lever = model.elements[e].drawn_position - model.drawn_start(e);
    loads[e].tail<3>() += lever.cross(loads[e].head<3>());
    const int p = model.elements[e].parent;
    if (p >= 0) loads[p] += loads[e];
  }
  return loads;
}

Loads weights(const RodModel& model, const Vec3& gravity) {
  Loads outer(model.elements.size());
  for (int e = 0; e < model.size(); ++e) {
    const Element& element = model.elements[e];
    const Vec3 arm = -element.com_back * (element.drawn_rotation * Vec3::UnitZ());
    outer[e] << element.mass * gravity, arm.cross(element.mass * gravity);
  }
  return outer;
}

// Compliance of a segment and its joint in its own axes: energy = 1/2 load^T C load.
Vec6 compliance(const Element& element) {
  Vec6 c;
  c << element.length * element.stretch_stiffness.cwiseInverse(),
      element.bend_stiffness.cwiseInverse();
  return c;
}

Vec6 in_element(const Element& element, const Vec6& load) {
  const Quat back = element.drawn_rotation.conjugate();
  Vec6 turned;
  turned << back * Vec3(load.head<3>()), back * Vec3(load.tail<3>());
  return turned;
}

// The supports' reactions (6 each) that make the elastic energy of the drawn shape least.
Eigen::VectorXd reactions(const RodModel& model, const Loads& gravity_loads) {
  const int n = 6 * static_cast<int>(model.supports.size());
  std::vector<Loads> unit;
  for (int i = 0; i < n; ++i) {
    const Support& support = model.supports[i / 6];
    const Element& element = model.elements[support.element];
    Loads outer(model.elements.size(), Vec6::Zero());
    Vec6 load = Vec6::Unit(i % 6);
    const Vec3 arm = -support.back * (element.drawn_rotation * Vec3::UnitZ());
    load.tail<3>() += arm.cross(Vec3(load.head<3>()));
    outer[support.element] = load;
    unit.push_back(carried(model, outer));
  }
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (int e = 0; e < model.size(); ++e) {
    const Vec6 c = compliance(model.elements[e]);
    Eigen::Matrix<double, 6, Eigen::Dynamic> a(6, n);
    for (int i = 0; i < n; ++i) a.col(i) = in_element(model.elements[e], unit[i][e]);
    normal += a.transpose() * c.asDiagonal() * a;
    right -= a.transpose() * c.asDiagonal() * in_element(model.elements[e], gravity_loads[e]);
  }
  // A free joint (no rotational spring) takes no moment.
  for (int i = 0; i < n; ++i) {
    if (i % 6 < 3 || model.supports[i / 6].rotation_stiffness.maxCoeff() > 0.0) continue;
    normal.row(i).setZero();
    normal.col(i).setZero();
    normal(i, i) = 1.0;
    right[i] = 0.0;
  }
  return normal.ldlt().solve(right);
}

// The moment (E) that a joint bent by phi carries.
Vec3 moment_of(const Vec3& stiffness, const Vec3& phi) {
  return inverse_right_jacobian(phi).transpose() * stiffness.cwiseProduct(phi);
}

// The rotation phi that carries a moment (E): Newton, the load being brought up in steps, so that
// the answer is the one that grows from the unbent joint. Nothing where there is none below the
// largest bend.
std::optional<Vec3> bend_under(const Vec3& stiffness, const Vec3& moment) {
  constexpr int steps = 8, iterations = 20;
  constexpr double nudge = 1.0e-6;  // rad
  Vec3 phi = Vec3::Zero();
  for (int s = 1; s <= steps; ++s) {
    const Vec3 wanted = moment * s / steps;
    for (int i = 0; i < iterations; ++i) {
      Mat3 slope;
      for (int k = 0; k < 3; ++k) {
        const Vec3 d = nudge * Vec3::Unit(k);
        slope.col(k) =
            (moment_of(stiffness, phi + d) - moment_of(stiffness, phi - d)) / (2 * nudge);
      }
      const Vec3 missing = wanted - moment_of(stiffness, phi);
      if (missing.norm() <= 1.0e-13 * (1.0e-9 + wanted.norm())) break;
      phi += slope.inverse() * missing;
      if (!(phi.norm() < largest_bend)) return std::nullopt;
    }
  }
  if (!((moment_of(stiffness, phi) - moment).norm() <= 1.0e-12 * (1.0 + moment.norm())))
    return std::nullopt;
  return phi;
}

void preload(RodModel& model, const Eigen::VectorXd& reaction) {
  for (std::size_t s = 0; s < model.supports.size(); ++s) {
    Support& support = model.supports[s];
    const Element& element = model.elements[support.element];
    support.position = element.drawn_position -
                       support.back * (element.drawn_rotation * Vec3::UnitZ()) +
                       reaction.segment<3>(6 * s) / support.position_stiffness;
    support.rotation = element.drawn_rotation;
    if (support.rotation_stiffness.minCoeff() <= 0.0) continue;
    const Vec3 moment = element.drawn_rotation.conjugate() * Vec3(reaction.segment<3>(6 * s + 3));
    support.rotation =
        element.drawn_rotation *
        exp_map(-bend_under(support.rotation_stiffness, -moment).value_or(Vec3::Zero()));
  }
}

}  // namespace

Standing stand_as_drawn(RodModel& model, const Vec3& gravity) {
  Loads outer = weights(model, gravity);
  if (!model.supports.empty()) {
    const Eigen::VectorXd reaction = reactions(model, carried(model, outer));
    for (std::size_t s = 0; s < model.supports.size(); ++s) {
      const Support& support = model.supports[s];
      const Element& element = model.elements[support.element];
      const Vec3 force = reaction.segment<3>(6 * s);
      const Vec3 arm = -support.back * (element.drawn_rotation * Vec3::UnitZ());
      outer[support.element].head<3>() += force;
      outer[support.element].tail<3>() += arm.cross(force) + reaction.segment<3>(6 * s + 3);
    }
    preload(model, reaction);
  }
  const Loads loads = carried(model, outer);
  Standing standing;
  for (int e = 0; e < model.size(); ++e) {
    Element& element = model.elements[e];
    const Vec6 load = in_element(element, loads[e]);
    const std::optional<Vec3> bent = bend_under(element.bend_stiffness, load.tail<3>());
    if (!bent) {
      standing.solvable = false;
      standing.element = e;
      return standing;
    }
    const Vec3& phi = *bent;
    if (phi.norm() > standing.largest_rest_bend) {
      standing.largest_rest_bend = phi.norm();
      standing.element = e;
    }
    const Quat before =
        element.parent < 0 ? model.root.rotation : model.elements[element.parent].drawn_rotation;
    element.rest_rotation =
        (before.conjugate() * element.drawn_rotation * exp_map(-phi)).normalized();
    element.rest_strain = -load.head<3>().cwiseQuotient(element.stretch_stiffness);
  }
  return standing;
}

}  // namespace pedicel::cosserat
