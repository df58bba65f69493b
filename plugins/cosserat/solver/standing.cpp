#include "plugins/cosserat/solver/standing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/stop.h"
#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/exact_hessian.h"

namespace pedicel::cosserat {

namespace {

constexpr double largest_bend = 2.5;  // rad: nearer to pi the rotation vector is no longer unique

// Force and moment that every joint carries, W; one entry an element.
using Loads = std::vector<Vec6>;

// Statics of a tree, leaves first: each joint carries what acts beyond it. `outer` holds the outer
// force and the outer moment about the child node of each element.
Loads carried(const RodModel& model, const Loads& outer) {
  // Moments are about each element's child node. Carried to the parent's they gain the force's
  // lever, which is the way from that node to this one.
  Loads loads = outer;
  // Children come after their parents, so the order backwards is leaves first, and each element is
  // complete when it is added to its parent.
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
    // From the child node back to the centre of mass, where the weight acts.
    const Vec3 arm = -element.com_back * (element.drawn_rotation * Vec3::UnitZ());
    outer[e] << element.mass * gravity, arm.cross(element.mass * gravity);
  }
  return outer;
}

const Quat& rotation_before(const RodModel& model, int e) {
  const int p = model.elements[e].parent;
  return p < 0 ? model.root.rotation : model.elements[p].drawn_rotation;
}

// Stretch and shear from the straight segment, E: none but where open_welds() moved a node.
Vec3 drawn_strain(const RodModel& model, int e) {
  const Element& element = model.elements[e];
  return element.drawn_rotation.conjugate() *
             ((element.drawn_position - model.drawn_start(e)) / element.length) -
         Vec3::UnitZ();
}

// Displacement and rotation (W) of every element under `outer`, were the drawn shape unloaded: the
// linear solution, the one of least elastic energy. Nothing where a part of the plant is not held.
// Castigliano: with linear springs the true loads are those of least elastic energy. Any other
// choice would leave the plant drawn up against its own supports when gravity is taken away.
std::optional<Loads> displacements(const RodModel& model, const Loads& outer) {
  RodModel unloaded = model;
  for (int e = 0; e < model.size(); ++e) {
    Element& element = unloaded.elements[e];
    element.rest_strain = drawn_strain(model, e);
    element.rest_rotation = rotation_before(model, e).conjugate() * element.drawn_rotation;
  }
  // At an unstrained shape the exact Hessian is the linear stiffness, with supports and welds in
  // it.
  BlockSystem system(unloaded);
  add_exact_hessian(unloaded, drawn_state(unloaded), Vec3::Zero(), {}, system);
  for (int e = 0; e < model.size(); ++e) system.right_side(e) = outer[e];
  if (!system.solve()) return std::nullopt;
  Loads moved;
  for (int e = 0; e < model.size(); ++e) moved.push_back(system.solution(e));
  return moved;
}

// The moment (E) that a joint bent by phi carries.
// Of the energy 1/2 phi.K phi, by a small turn of the element and not by phi itself: the two differ
// by the right Jacobian of the rotation, which is 1 only where the joint is hardly bent.
Vec3 moment_of(const Vec3& stiffness, const Vec3& phi) {
  return inverse_right_jacobian(phi).transpose() * stiffness.cwiseProduct(phi);
}

// The rotation phi that carries a moment (E): Newton, the load being brought up in steps, so that
// the answer is the one that grows from the unbent joint. Nothing where there is none below the
// largest bend.
std::optional<Vec3> bend_under(const Vec3& stiffness, const Vec3& moment) {
  // In one go Newton may land on a bend beyond a half turn that carries the same moment. Eight
  // steps are short enough to stay on the branch that grows from zero.
  constexpr int steps = 8, iterations = 20;
  constexpr double nudge = 1.0e-6;  // rad
  Vec3 phi = Vec3::Zero();
  for (int s = 1; s <= steps; ++s) {
    const Vec3 wanted = moment * s / steps;
    for (int i = 0; i < iterations; ++i) {
      Mat3 slope;
      for (int k = 0; k < 3; ++k) {
        const Vec3 d = nudge * Vec3::Unit(k);
        // By differences: the slope in closed form would be the derivative of a Jacobian, and this
        // is made once at set-up and not in every step.
        slope.col(k) =
            (moment_of(stiffness, phi + d) - moment_of(stiffness, phi - d)) / (2 * nudge);
      }
      const Vec3 missing = wanted - moment_of(stiffness, phi);
      if (missing.norm() <= 1.0e-13 * (1.0e-9 + wanted.norm())) break;
      phi += slope.inverse() * missing;
      if (!(phi.norm() < largest_bend)) return std::nullopt;
    }
  }
  // Written so that a NaN fails, too. The bound is on what is left, since a loop that ran out says
  // nothing.
  if (!((moment_of(stiffness, phi) - moment).norm() <= 1.0e-12 * (1.0 + moment.norm())))
    return std::nullopt;
  return phi;
}

// The unloaded rotation from `before` to `rotation` of a joint that carries a moment (W) between
// them.
std::optional<Quat> rest_rotation(const Quat& before, const Quat& rotation, const Vec3& stiffness,
                                  const Vec3& moment) {
  const std::optional<Vec3> phi = bend_under(stiffness, rotation.conjugate() * moment);
  if (!phi) return std::nullopt;
  // phi turns the rest rotation into the drawn one from the right: q = q_parent rest exp(phi).
  return (before.conjugate() * rotation * exp_map(-*phi)).normalized();
}

// The moment (W) with which a rotational spring in the axes of `rotation` opposes a small turn (W);
// a spring that is free about an axis is left unloaded.
Vec3 moment_under(const Vec3& stiffness, const Quat& rotation, const Vec3& turn) {
  // The moment is turned into a rest rotation by inverting the spring's law, and a spring without
  // stiffness about an axis has no inverse.
  if (stiffness.minCoeff() <= 0.0) return Vec3::Zero();
  return rotation * stiffness.cwiseProduct(rotation.conjugate() * turn);
}

Vec3 held_point_arm(const RodModel& model, const Support& support) {
  return -support.back * (model.elements[support.element].drawn_rotation * Vec3::UnitZ());
}

// Loads a support as in the linear solution, and adds its reaction to the outer loads.
bool load_support(const RodModel& model, const Loads& moved, Support& support, Loads& outer) {
  const Element& element = model.elements[support.element];
  const Vec3 arm = held_point_arm(model, support);
  const Vec6& own = moved[support.element];
  const Vec3 turn = own.tail<3>();
  const Vec3 shift = own.head<3>() + turn.cross(arm);
  const Vec3 force = -support.position_stiffness * shift;
  const Vec3 moment = moment_under(support.rotation_stiffness, element.drawn_rotation, turn);
  // The spring's other end goes against the displacement, so that stretched to the drawn shape it
  // carries just this force.
  support.position = element.drawn_position + arm - shift;
  support.rotation = element.drawn_rotation;
  outer[support.element].head<3>() += force;
  outer[support.element].tail<3>() += arm.cross(force) - moment;
  // Exactly zero: nothing to solve, and the rest rotation keeps the bits of the drawn one.
  if (moment.isZero(0.0)) return true;
  const auto rest =
      rest_rotation(Quat::Identity(), element.drawn_rotation, support.rotation_stiffness, moment);
  support.rotation = rest.value_or(element.drawn_rotation);
  return rest.has_value();
}

// A weld is drawn closed, and carries its force through a gap of force / stiffness: the nodes that
// are welded to another one are moved by that.
void open_welds(RodModel& model, const Loads& moved) {
  const std::vector<int> first = first_of_welded(model);
  // The first of those that are welded in one place stays where it was drawn, and the others open
  // against it: only differences load a weld.
  for (int e = 0; e < model.size(); ++e)
    if (first[e] != e)
      model.elements[e].drawn_position =
          model.elements[first[e]].drawn_position + (moved[e] - moved[first[e]]).head<3>();
}

// Loads a weld that was opened as in the linear solution, and adds what it does to the outer loads.
bool load_weld(const RodModel& model, const Loads& moved, Weld& weld, Loads& outer) {
  const Element &a = model.elements[weld.a], &b = model.elements[weld.b];
  const Vec3 force = weld.position_stiffness * (b.drawn_position - a.drawn_position);
  const Vec3 moment = moment_under(weld.bend_stiffness, b.drawn_rotation,
                                   (moved[weld.b] - moved[weld.a]).tail<3>());
  weld.rest_rotation = (a.drawn_rotation.conjugate() * b.drawn_rotation).normalized();
  Vec6 pull;
  // In equal parts and against each other: a weld is inner, and must not add to what holds the
  // plant.
  pull << force, moment;
  outer[weld.a] += pull;
  outer[weld.b] -= pull;
  if (moment.isZero(0.0)) return true;
  const auto rest = rest_rotation(a.drawn_rotation, b.drawn_rotation, weld.bend_stiffness, moment);
  weld.rest_rotation = rest.value_or(weld.rest_rotation);
  return rest.has_value();
}

// Loads supports and welds, adding what they do to the outer loads. Comes back with the element of
// one that cannot be loaded; -1: none.
int load_redundants(RodModel& model, Loads& outer) {
  if (model.supports.empty() && model.welds.empty()) return -1;
  const std::optional<Loads> moved = displacements(model, outer);
  if (!moved) return 0;  // so soft somewhere that rounding leaves nothing of it
  // Before the welds are loaded: a weld's force is its stiffness times the gap that this makes.
  open_welds(model, *moved);
  for (Support& support : model.supports)
    if (!load_support(model, *moved, support, outer)) return support.element;
  for (Weld& weld : model.welds)
    if (!load_weld(model, *moved, weld, outer)) return weld.b;
  return -1;
}

}  // namespace

Standing stand_as_drawn(RodModel& model, const Vec3& gravity) {
  Standing standing;
  Loads outer = weights(model, gravity);
  standing.element = load_redundants(model, outer);
  standing.solvable = standing.element < 0;
  if (!standing.solvable) return standing;
  // By now `outer` holds weights and all that supports and welds do. The tree that is left is
  // statically determinate, so the pass balances it exactly, whatever the linear solution was off
  // by.
  const Loads loads = carried(model, outer);
  for (int e = 0; e < model.size(); ++e) {
    throw_if_stopped();
    Element& element = model.elements[e];
    const Quat& before = rotation_before(model, e);
    const auto rest =
        rest_rotation(before, element.drawn_rotation, element.bend_stiffness, loads[e].tail<3>());
    if (!rest) {
      standing.solvable = false;
      standing.element = e;
      return standing;
    }
    element.rest_rotation = *rest;
    // Rest is the drawn strain less compliance times load, the load in the element's own axes.
    element.rest_strain =
        drawn_strain(model, e) - (element.drawn_rotation.conjugate() * Vec3(loads[e].head<3>()))
                                     .cwiseQuotient(element.stretch_stiffness);
    const double bend =
        log_map(rest->conjugate() * (before.conjugate() * element.drawn_rotation)).norm();
    if (bend <= standing.largest_rest_bend) continue;
    standing.largest_rest_bend = bend;
    standing.element = e;
  }
  return standing;
}

Residual settled_from(const RodModel& drawn, const RodModel& standing, const Vec3& gravity) {
  RodState state = drawn_state(standing);
  Residual residual;
  // Measured against the drawing and not against the standing shape: open_welds() may have moved
  // nodes, and that is part of what is wrong.
  residual.settled = settle(standing, state, gravity).errors == 0;
  double squares = 0.0;
  for (int e = 0; e < drawn.size(); ++e) {
    const double moved = (state.position[e] - drawn.elements[e].drawn_position).norm();
    squares += moved * moved;
    if (moved <= residual.largest) continue;
    residual.largest = moved;
    residual.element = e;
  }
  residual.rms = std::sqrt(squares / drawn.size());
  return residual;
}

}  // namespace pedicel::cosserat
