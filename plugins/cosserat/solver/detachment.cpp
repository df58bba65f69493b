#include "plugins/cosserat/solver/detachment.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pedicel::cosserat {

namespace {

// What the joint under a fruit carries against each of its thresholds.
// Thresholds are looked at once a step, after the solver, and never within Newton's iterations. The
// step then minimises one smooth potential, and a stalk cannot break at an iterate that the plant
// never reaches. What breaks bears its load for the rest of that step.
struct Margins {
  StalkNumbers carried;
  double used = 0.0;  // largest ratio to a threshold
  std::string_view cause = "";
};

bool has_limit_of_load(const Fruit& fruit) {
  return !fruit.law && (fruit.thresholds.force < Thresholds::never ||
                        fruit.thresholds.moment < Thresholds::never ||
                        fruit.thresholds.torsion < Thresholds::never);
}

// Kelvin and Voigt: stress = E (strain + time rate). The rate is the step's own, as the potential
// of the step has it: that of the velocities at its end is no difference of these strains. By the
// elastic part alone a stalk that is pulled evenly would part later by its damping time.
void add_damping(const RodModel& model, const RodState& state, int fruit, const StalkStart& start,
                 StalkNumbers& carried) {
  if (start.loads.empty() || !has_limit_of_load(model.fruits[fruit])) return;
  const int e = model.fruits[fruit].element;
  const double share = model.elements[e].damping_time / start.dt;
  const JointLoad now = joint_load(model, state, e), &before = start.loads[fruit];
  const Vec3 force = now.force + share * (now.force - before.force);
  const Vec3 moment = now.moment + share * (now.moment - before.moment);
  carried[stalk_force] = force.norm();
  carried[stalk_moment] = moment.head<2>().norm();
  carried[stalk_torsion] = std::abs(moment.z());
}

Margins margins(const RodModel& model, const RodState& state, int index,
                const StalkStart& start = {}) {
  const Fruit& fruit = model.fruits[index];
  Margins m{stalk_numbers(model, state, fruit.element)};
  add_damping(model, state, index, start, m.carried);
  if (fruit.law) {
    // A scale that was left out is infinite: its ratio is 0, and it takes no part. The sum reaches
    // 1 where the stalk breaks, so that laws and thresholds report the same kind of number.
    m.used = std::pow(m.carried[stalk_force] / fruit.law->force, fruit.law->exponents[0]) +
             std::pow(m.carried[stalk_moment] / fruit.law->moment, fruit.law->exponents[1]) +
             std::pow(m.carried[stalk_torsion] / fruit.law->torsion, fruit.law->exponents[2]);
    m.cause = "law";
    return m;
  }
  // Thresholds are one by one: the largest ratio counts, and names the cause. Strains stand before
  // loads, and only a larger ratio replaces an earlier one, so that a tie keeps the paper's own
  // criterion.
  for (std::size_t i = 0; i < stalk_limits.size(); ++i) {
    const double ratio = m.carried[i] / (fruit.thresholds.*stalk_limits[i].threshold);
    if (ratio <= m.used) continue;
    m.used = ratio;
    m.cause = stalk_limits[i].name;
  }
  return m;
}

bool is_tip(const RodModel& model, const RodState& state, const Fruit& fruit) {
  // The stub goes along only where nothing else needs the element. Otherwise the plant would lose a
  // segment that still carries a twig, a leaf's weld or the far half of its own length.
  if (fruit.back > 0.5 * model.elements[fruit.element].length) return false;
  // Another fruit there stays on the plant, and so does what it hangs on.
  for (std::size_t f = 0; f < model.fruits.size(); ++f)
    if (&model.fruits[f] != &fruit && model.fruits[f].element == fruit.element &&
        !state.fruit_gone[f])
      return false;
  // Children come after their parents in a model, so nothing before the element can hang on it.
  for (int e = fruit.element + 1; e < model.size(); ++e)
    if (model.elements[e].parent == fruit.element && state.alive[e]) return false;
  for (const Weld& weld : model.welds)
    if (weld.a == fruit.element || weld.b == fruit.element) return false;
  return true;
}

DetachEvent record(const RodModel& model, const RodState& state, int index, const Margins& m) {
  const Fruit& fruit = model.fruits[index];
  const Element& element = model.elements[fruit.element];
  const Quat& q = state.orientation[fruit.element];
  DetachEvent event;
  event.time = state.time;
  event.fruit = index;
  event.cause = m.cause;
  for (std::size_t i = 0; i < stalk_limits.size(); ++i)
    event.*stalk_limits[i].at_break = m.carried[i];
  const Vec3 axis = q * Vec3::UnitZ();
  // Without a sign: a stalk that hangs straight down and one that stands straight up are both at 0.
  // Rounding may push the cosine of either above 1, whose arc cosine is no number.
  event.angle = std::acos(std::clamp(std::abs(axis.z()), 0.0, 1.0));
  // All that the rigid body starts from is read before the fruit is taken off: take_off() moves the
  // element's centre of mass, and the velocities of the state are those of that centre.
  event.position_W = point_on(model, state, fruit.element, fruit.back);
  event.orientation = q;
  event.velocity_W = velocity_on(model, state, fruit.element, fruit.back);
  event.angular_velocity_W = q * state.angular_velocity[fruit.element];
  event.mass = fruit_mass(fruit);
  if (!is_tip(model, state, fruit)) return event;
  // The element's mass holds its fruit already, as all hung masses are lumped into it.
  event.mass = element.mass;
  event.stub_length = element.length - fruit.back;
  event.stub_radius = 0.5 * (element.radius_near + element.radius_far);
  return event;
}

// The segment lost a fruit: its centre of mass moves, and with it the velocity that the state
// holds.
// Only the reference point changes, and no motion: the axis lies along E's third axis, so the shift
// of the centre is along it, and omega (E) crossed with the shift is what the new centre moves
// faster.
void lighten(RodModel& model, RodState& state, int e) {
  const Quat q = state.orientation[e];
  const Vec3 omega = state.angular_velocity[e];
  const double com_before = model.elements[e].com_back;
  lump_inertia(model, e, state.fruit_gone);
  state.velocity[e] += q * omega.cross(Vec3(0, 0, com_before - model.elements[e].com_back));
}

}  // namespace

StalkNumbers stalk_numbers(const RodModel& model, const RodState& state, int element) {
  // Strains are from the unloaded shape, as the paper's are. A stalk that hangs under its own fruit
  // has therefore used a part of its limit before anything pulls.
  const Strain strain = strain_of(model, state, element);
  const JointLoad load = joint_load(model, state, element);
  return {strain.stretch.norm(), strain.bend.norm(), load.force.norm(),
          load.moment.head<2>().norm(), std::abs(load.moment.z())};
}

double margin_used(const RodModel& model, const RodState& state, int fruit) {
  if (state.fruit_gone[fruit]) return 0.0;
  return margins(model, state, fruit).used;
}

void take_off(RodModel& model, RodState& state, int fruit) {
  const int e = model.fruits[fruit].element;
  const bool with_stub = is_tip(model, state, model.fruits[fruit]);
  state.fruit_gone[fruit] = true;
  // What pulled is gone at once: a second-order step would take the velocity's bend for curvature,
  // and be of first order for good.
  state.previous_dt = 0.0;
  if (with_stub)
    state.alive[e] = 0;
  else
    lighten(model, state, e);
}

CutOff cut(const RodModel& model, RodState& state, int element) {
  CutOff off;
  std::vector<char> carried(model.elements.size(), 0);
  // One pass is enough, because a parent always stands before its children. The pass marks dead
  // elements, too: what hangs on one that fell off earlier must not be taken for a part that stays.
  for (int e = element; e < model.size(); ++e) {
    const int parent = model.elements[e].parent;
    carried[e] = e == element || (parent >= 0 && carried[parent]);
    if (carried[e] && state.alive[e]) off.elements.push_back(e);
  }
  const auto centre_of = [&](int e) {
    return point_on(model, state, e, model.elements[e].com_back);
  };
  Vec3 momentum = Vec3::Zero();
  for (const int e : off.elements) {
    const double mass = model.elements[e].mass;
    off.mass += mass;
    off.centre_W += mass * centre_of(e);
    momentum += mass * state.velocity[e];
  }
  off.centre_W /= off.mass;
  off.velocity_W = momentum / off.mass;
  // The rigid body gets the velocity and the spin that keep linear and angular momentum. Averaging
  // the segments' rates would lose what the part swings with about its own centre.
  Vec3 spin = Vec3::Zero();  // N m s, about the centre
  Mat3 inertia = Mat3::Zero();
  for (const int e : off.elements) {
    const Element& one = model.elements[e];
    // Inertias and rates of the state are in E, each in its own segment's axes. They are summed in
    // W. The second term is the parallel-axis theorem.
    const Mat3 r = state.orientation[e].toRotationMatrix();
    const Vec3 arm = centre_of(e) - off.centre_W;
    inertia += r * one.inertia.asDiagonal() * r.transpose() +
               one.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    spin += r * one.inertia.cwiseProduct(state.angular_velocity[e]) +
            one.mass * arm.cross(state.velocity[e]);
  }
  off.angular_velocity_W = inertia.ldlt().solve(spin);
  for (const int e : off.elements) state.alive[e] = 0;
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
    if (state.fruit_gone[f] || !carried[model.fruits[f].element]) continue;
    off.fruits.push_back(f);
    state.fruit_gone[f] = true;
  }
  state.previous_dt = 0.0;  // as take_off()
  return off;
}

void begin_stalks(const RodModel& model, const RodState& state, double dt, StalkStart& start) {
  start.dt = dt;
  start.loads.clear();
  if (std::ranges::none_of(model.fruits, has_limit_of_load)) return;
  start.loads.resize(model.fruits.size());
  for (std::size_t f = 0; f < model.fruits.size(); ++f)
    if (!state.fruit_gone[f] && has_limit_of_load(model.fruits[f]))
      start.loads[f] = joint_load(model, state, model.fruits[f].element);
}

void detach(RodModel& model, RodState& state, std::vector<DetachEvent>& events,
            const StalkStart& start) {
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
    if (state.fruit_gone[f] || !state.alive[model.fruits[f].element]) continue;
    const Margins m = margins(model, state, f, start);
    // Recorded first, then taken off: the record is of the joint that broke, and after take_off()
    // there is no joint. Fruits are taken in the order of the file, so a run repeats to the bit.
    if (m.used < 1.0) continue;
    events.push_back(record(model, state, f, m));
    take_off(model, state, f);
  }
}

}  // namespace pedicel::cosserat
