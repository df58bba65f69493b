#include "cosserat/contact_terms.h"

#include <algorithm>
#include <numeric>

#include "cosserat/rotation.h"
#include "cosserat/self_contact.h"

namespace pedicel::cosserat {

namespace {

constexpr std::size_t stretch_length = 32;  // contacts that a thread takes at a time

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

// task(first, end) for stretches of all contacts, perhaps at once. Their length does not depend on
// the number of threads, and a thread gets the same ones each time, which lie in its core's cache.
template <class Task>
void ContactTerms::for_each_stretch(const Task& task) const {
  const std::size_t count = active_.size();
  const std::size_t stretches = (count + stretch_length - 1) / stretch_length;
  const int parts = loop_.parts(stretches, 1);
  loop_.each(parts, [&](int part) {
    const std::size_t end = stretches * (part + 1) / parts * stretch_length;
    for (std::size_t i = stretches * part / parts * stretch_length; i < std::min(count, end);
         i += stretch_length)
      task(i, std::min(count, i + stretch_length));
  });
}

// The sum of energy_of(i) (J) over all contacts i, stretch by stretch.
template <class EnergyOf>
double ContactTerms::sum(const EnergyOf& energy_of) const {
  sums_.assign((active_.size() + stretch_length - 1) / stretch_length, 0.0);
  for_each_stretch([&](std::size_t first, std::size_t end) {
    double& energy = sums_[first / stretch_length];
    for (std::size_t i = first; i < end; ++i) energy += energy_of(i);
  });
  return std::accumulate(sums_.begin(), sums_.end(), 0.0);
}

void ContactTerms::find(const RodModel& model, const RodState& start, const RodState& iterate,
                        double dt, std::span<ContactSource* const> sources) {
  found_.clear();
  for (ContactSource* source : sources) source->find(model, iterate, dt, found_);
  active_.resize(found_.size());
  energies_.resize(found_.size());
  blocks_.resize(found_.size());
  moves_.resize(found_.size());
  for_each_stretch([&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      active_[i] = activated(found_[i], model, start, iterate);
      push_at_iterate(i, iterate);
    }
  });
  only_with_itself_ = std::all_of(found_.begin(), found_.end(), [](const ContactPoint& point) {
    return is_self_contact(point.collider);
  });
  share_gives(iterate);
  energy_ = std::accumulate(energies_.begin(), energies_.end(), 0.0);
}

// Normals and places on the segments stay as they were found; the plane between the two sides of a
// self-contact goes along with the middle of both.
void ContactTerms::follow(const RodState& iterate) {
  for_each_stretch([&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      Active& contact = active_[i];
      const Vec3 now = place(iterate, contact.element, contact.arm_E);
      moves_[i] = now - contact.place_W;
      contact.place_W = now;
    }
  });
  for_each_stretch([&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      Active& contact = active_[i];
      const std::size_t other = i ^ 1;  // the two sides follow each other
      const Vec3 plane = 0.5 * (moves_[i] + moves_[other]);
      contact.point.gap += contact.point.normal_W.dot(moves_[i] - plane);
      contact.point.surface_motion_W += plane;
      take_tangent(contact.point);
      contact.stiffness = contact.point.stiffness;
      push_at_iterate(i, iterate);
    }
  });
  energy_ = std::accumulate(energies_.begin(), energies_.end(), 0.0);
}

ContactTerms::Active ContactTerms::activated(const ContactPoint& point, const RodModel& model,
                                             const RodState& start, const RodState& iterate) const {
  Active contact;
  contact.point = point;
  contact.element = model.shapes[point.shape].element;
  const Quat& q = iterate.orientation[contact.element];
  const Vec3 arm_W = -point.back * third_axis(q) - point.radius * point.normal_W;
  contact.arm_E = q.conjugate() * arm_W;
  contact.place_W = iterate.position[contact.element] + arm_W;
  contact.start_W = place(start, contact.element, contact.arm_E);
  contact.stiffness = point.stiffness;
  if (const Memory* memory = remembered(point.shape, point.collider)) {
    contact.stretch_W = memory->stretch_W;
    contact.limit = point.friction * memory->normal;
  }
  return contact;
}

// Contacts that push one collider together move it together: each one counts the others' share as
// if they carried what it carries.
void ContactTerms::share_gives(const RodState& iterate) {
  const auto pushes = [](const Active& contact) {
    return contact.point.gap < contact.point.margin;
  };
  for (std::size_t i = 0; i < active_.size(); ++i) {
    Active& contact = active_[i];
    const ContactPoint& own = contact.point;
    if (own.give <= 0.0) continue;
    int together = pushes(contact) ? 0 : 1;
    for (const Active& other : active_)
      together += pushes(other) && other.point.collider == own.collider;
    contact.give = together * own.give;
    contact.stiffness = own.stiffness / (1.0 + own.stiffness * contact.give);
    push_at_iterate(i, iterate);
  }
}

void ContactTerms::push_at_iterate(std::size_t contact, const RodState& iterate) {
  const Active& active = active_[contact];
  energies_[contact] = 0.0;
  blocks_[contact].element = -1;
  if (is_idle(active)) return;
  const Push now = push(active, active.place_W);
  energies_[contact] = now.energy;
  blocks_[contact] = block_of(active, now, active.place_W - iterate.position[active.element]);
}

const ContactTerms::Memory* ContactTerms::remembered(int shape, int collider) const {
  const auto it = std::lower_bound(memory_.begin(), memory_.end(), std::pair(shape, collider),
                                   [](const Memory& m, const std::pair<int, int>& key) {
                                     return before(m.shape, m.collider, key.first, key.second);
                                   });
  if (it == memory_.end() || it->shape != shape || it->collider != collider) return nullptr;
  return &*it;
}

// With the surface at `now`.
ContactTerms::Push ContactTerms::push(const Active& contact, const Vec3& now) {
  const ContactPoint& point = contact.point;
  const double overlap =
      std::max(0.0, point.margin - point.gap - point.normal_W.dot(now - contact.place_W));
  Push push;
  push.normal_force = contact.stiffness * overlap * point.normal_W;
  push.energy = 0.5 * contact.stiffness * overlap * overlap;
  if (contact.limit == 0.0) {
    push.friction_force.setZero();
    push.stretch.setZero();
    push.slipping = true;
    return push;
  }
  push.stretch = tangential(contact.stretch_W + now - contact.start_W - point.surface_motion_W,
                            point.normal_W);
  const double length = push.stretch.norm();
  push.slipping = contact.stiffness * length > contact.limit;
  if (push.slipping) {
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

// The spring's stiffness is one along the normal and another one across it. The sliding spring's is
// the secant stiffness: an upper bound of its Hessian, so Newton stays stable.
ElementBlock ContactTerms::block_of(const Active& contact, const Push& push, const Vec3& arm) {
  const ContactPoint& point = contact.point;
  const double along = push.normal_force != Vec3::Zero() ? contact.stiffness : 0.0;
  double across = 0.0;
  if (!push.slipping)
    across = contact.stiffness;
  else if (contact.limit > 0.0)
    across = contact.limit / tangential(contact.stretch_W + contact.place_W - contact.start_W -
                                            point.surface_motion_W,
                                        point.normal_W)
                                 .norm();
  return point_spring(contact.element, arm, point.normal_W, along, across,
                      push.normal_force + push.friction_force);
}

double ContactTerms::potential(const RodModel&, const RodState& state) const {
  return sum([&](std::size_t i) {
    const Active& contact = active_[i];
    return push(contact, place(state, contact.element, contact.arm_E)).energy;
  });
}

// The two sides of a self-contact, which follow each other, meet in the middle of where both went
// in the last iteration: so they carry the same force.
void ContactTerms::finish(const RodModel&, const RodState& end) {
  const std::size_t count = active_.size();
  const auto are_sides = [&](std::size_t i) {  // it and the next one
    if (i + 1 >= count) return false;
    const ContactPoint &a = active_[i].point, &b = active_[i + 1].point;
    return a.collider == self_contact_base + b.shape && b.collider == self_contact_base + a.shape;
  };
  ends_.resize(count);
  for_each_stretch([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      moves_[i] = place(end, active_[i].element, active_[i].arm_E) - active_[i].place_W;
  });
  for_each_stretch([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Active& contact = active_[i];
      const Vec3 now_W = contact.place_W + moves_[i];
      const bool is_first = are_sides(i);
      if (is_first || (i > 0 && are_sides(i - 1))) {
        const Vec3 middle = 0.5 * (moves_[i] + moves_[is_first ? i + 1 : i - 1]);
        contact.place_W += middle;
        contact.start_W += middle;
      }
      ends_[i] = push(contact, now_W);
    }
  });
  memory_.clear();
  forces_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Push& now = ends_[i];
    const double normal = now.normal_force.norm();
    if (normal == 0.0) continue;
    const Active& contact = active_[i];
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
