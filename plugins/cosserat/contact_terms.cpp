#include "cosserat/contact_terms.h"

#include <algorithm>

#include "cosserat/self_contact.h"

namespace pedicel::cosserat {

namespace {

Vec3 tangential(const Vec3& v, const Vec3& normal) {
  return v - v.dot(normal) * normal;
}

Vec3 place(const RodState& state, int element, const Vec3& arm_E) {
  return state.position[element] + state.orientation[element] * arm_E;
}

bool before(int shape_a, int collider_a, int shape_b, int collider_b) {
  return shape_a != shape_b ? shape_a < shape_b : collider_a < collider_b;
}

}  // namespace

void ContactTerms::find(const RodModel& model, const RodState& start, const RodState& iterate,
                        double dt, std::span<ContactSource* const> sources) {
  found_.clear();
  active_.clear();
  only_with_itself_ = true;
  for (ContactSource* source : sources) source->find(model, iterate, dt, found_);
  for (const ContactPoint& point : found_) {
    Active contact;
    contact.point = point;
    contact.element = model.shapes[point.shape].element;
    only_with_itself_ = only_with_itself_ && is_self_contact(point.collider);
    const Quat& q = iterate.orientation[contact.element];
    contact.arm_E = Vec3(0, 0, -point.back) - point.radius * (q.conjugate() * point.normal_W);
    contact.place_W = place(iterate, contact.element, contact.arm_E);
    contact.start_W = place(start, contact.element, contact.arm_E);
    if (const Memory* memory = remembered(point.shape, point.collider)) {
      contact.stretch_W = memory->stretch_W;
      contact.limit = point.friction * memory->normal;
    }
    active_.push_back(contact);
  }
  share_gives();
}

// Contacts that push one collider together move it together: each one counts the others' share as
// if they carried what it carries.
void ContactTerms::share_gives() {
  const auto pushes = [](const Active& contact) {
    return contact.point.gap < contact.point.margin;
  };
  for (Active& contact : active_) {
    const ContactPoint& own = contact.point;
    int together = pushes(contact) ? 0 : 1;
    if (own.give > 0.0)
      for (const Active& other : active_)
        together += pushes(other) && other.point.collider == own.collider;
    contact.give = together * own.give;
    contact.stiffness = own.stiffness / (1.0 + own.stiffness * contact.give);
  }
}

const ContactTerms::Memory* ContactTerms::remembered(int shape, int collider) const {
  const auto it = std::lower_bound(memory_.begin(), memory_.end(), std::pair(shape, collider),
                                   [](const Memory& m, const std::pair<int, int>& key) {
                                     return before(m.shape, m.collider, key.first, key.second);
                                   });
  if (it == memory_.end() || it->shape != shape || it->collider != collider) return nullptr;
  return &*it;
}

ContactTerms::Push ContactTerms::push(const Active& contact, const RodState& state) const {
  const ContactPoint& point = contact.point;
  const Vec3 now = place(state, contact.element, contact.arm_E);
  const double overlap =
      std::max(0.0, point.margin - point.gap - point.normal_W.dot(now - contact.place_W));
  Push push;
  push.normal_force = contact.stiffness * overlap * point.normal_W;
  push.energy = 0.5 * contact.stiffness * overlap * overlap;
  push.stretch = tangential(contact.stretch_W + now - contact.start_W - point.surface_motion_W,
                            point.normal_W);
  const double length = push.stretch.norm();
  push.slipping = contact.stiffness * length > contact.limit || contact.limit == 0.0;
  if (contact.limit == 0.0) {
    push.friction_force.setZero();
    push.stretch.setZero();
  } else if (push.slipping) {
    push.energy += contact.limit * (length - 0.5 * contact.limit / contact.stiffness);
    push.friction_force = -contact.limit / length * push.stretch;
    push.stretch *= contact.limit / (contact.stiffness * length);
  } else {
    push.energy += 0.5 * contact.stiffness * length * length;
    push.friction_force = -contact.stiffness * push.stretch;
  }
  return push;
}

// Neither pushes at the iterate nor rubs.
bool ContactTerms::is_idle(const Active& contact) {
  return contact.point.gap >= contact.point.margin && contact.limit == 0.0;
}

double ContactTerms::linearise(const RodModel&, const RodState& iterate,
                               DiagonalBlocks& blocks) const {
  double energy = 0.0;
  for (const Active& contact : active_) {
    const ContactPoint& point = contact.point;
    if (is_idle(contact)) continue;
    const Push push_now = push(contact, iterate);
    energy += push_now.energy;
    const Mat3 normal = point.normal_W * point.normal_W.transpose();
    Mat3 hessian = Mat3::Zero();
    if (push_now.normal_force != Vec3::Zero()) hessian += contact.stiffness * normal;
    if (push_now.slipping && contact.limit > 0.0) {
      // The sliding spring's secant stiffness: an upper bound of its Hessian, so Newton stays
      // stable.
      const Vec3 total =
          tangential(contact.stretch_W + contact.place_W - contact.start_W - point.surface_motion_W,
                     point.normal_W);
      hessian += contact.limit / total.norm() * (Mat3::Identity() - normal);
    } else if (!push_now.slipping) {
      hessian += contact.stiffness * (Mat3::Identity() - normal);
    }
    const Vec3 arm = contact.place_W - iterate.position[contact.element];
    add_point_spring(blocks, contact.element, arm, hessian,
                     push_now.normal_force + push_now.friction_force);
  }
  return energy;
}

double ContactTerms::potential(const RodModel&, const RodState& state) const {
  double energy = 0.0;
  for (const Active& contact : active_) energy += push(contact, state).energy;
  return energy;
}

// The two sides of a self-contact, which follow each other, meet in the middle of where both went
// in the last iteration: so they carry the same force.
void ContactTerms::finish(const RodModel&, const RodState& end) {
  memory_.clear();
  forces_.clear();
  const auto moved = [&](const Active& contact) -> Vec3 {
    return place(end, contact.element, contact.arm_E) - contact.place_W;
  };
  const auto are_sides = [](const ContactPoint& a, const ContactPoint& b) {
    return a.collider == self_contact_base + b.shape && b.collider == self_contact_base + a.shape;
  };
  for (std::size_t i = 0; i + 1 < active_.size(); ++i) {
    Active &a = active_[i], &b = active_[i + 1];
    if (!are_sides(a.point, b.point)) continue;
    const Vec3 middle = 0.5 * (moved(a) + moved(b));
    for (Active* side : {&a, &b}) {
      side->place_W += middle;
      side->start_W += middle;
    }
    ++i;
  }
  for (const Active& contact : active_) {
    const Push now = push(contact, end);
    const double normal = now.normal_force.norm();
    if (normal == 0.0) continue;
    ContactPoint point = contact.point;
    point.gap += contact.give * normal;
    memory_.push_back({point.shape, point.collider, now.stretch, normal});
    forces_.push_back({point, place(end, contact.element, contact.arm_E), normal,
                       now.friction_force, now.slipping});
  }
  std::sort(memory_.begin(), memory_.end(), [](const Memory& a, const Memory& b) {
    return before(a.shape, a.collider, b.shape, b.collider);
  });
}

void ContactTerms::add_to(std::vector<ContactForce>& forces, double share) const {
  for (ContactForce force : forces_) {
    force.normal *= share;
    force.tangential_W *= share;
    force.point.stiffness *= share;
    force.point.surface_motion_W /= share;
    forces.push_back(force);
  }
}

double ContactTerms::deepest() const {
  double deepest = 0.0;
  for (const ContactForce& force : forces_) deepest = std::max(deepest, -force.point.gap);
  return deepest;
}

}  // namespace pedicel::cosserat
