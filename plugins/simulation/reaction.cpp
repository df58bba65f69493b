#include "plugins/simulation/reaction.h"

#include "plugins/simulation/colliders.h"

namespace pedicel::simulation {

using coupling::Collider;
using coupling::ContactSum;

Reaction::Reaction(world::SimWorld& world, RobotControl* robot, coupling::ColliderSet& colliders,
                   int first_body)
    : world_(world), robot_(robot), colliders_(colliders), first_body_(first_body) {
  // One push a collider at most: a step must not allocate.
  reactions_.reserve(colliders.size());
  // Plants need to know how far things give way in the very first step, too.
  const std::vector<ContactSum> none(colliders.size());
  for (int i = 0; i < colliders.size(); ++i) colliders.set_give(i, give_of(i, none));
}

void Reaction::act(const coupling::ContactReport& contacts) {
  if (robot_) push_robot(contacts);
  // Robot and bodies do not know of each other here: Bullet couples them in its next step.
  push_bodies(contacts);
  for (int i = 0; i < colliders_.size(); ++i)
    colliders_.set_give(i, give_of(i, contacts.colliders()));
}

void Reaction::push_robot(const coupling::ContactReport& contacts) {
  reactions_.clear();
  for (int i = 0; i < colliders_.size(); ++i) {
    const ContactSum& sum = contacts.colliders()[i];
    if (colliders_.collider(i).body == robot_body && sum.contacts > 0 && !is_gripping(i))
      reactions_.push_back({colliders_.collider(i).link, sum.force_W, sum.place_W, sum.moment_W});
  }
  // Also without pushes: the motors have to hear that nothing pushes any more.
  // All at once: the inverse mass matrix of the robot couples its links.
  robot_->robot().add_reactions(reactions_, world_.dt());
}

void Reaction::push_bodies(const coupling::ContactReport& contacts) {
  for (int i = 0; i < colliders_.size(); ++i) {
    const ContactSum& sum = contacts.colliders()[i];
    const int body = colliders_.collider(i).body;
    // The ground and the robot have numbers below 0.
    if (body < first_body_ || sum.contacts == 0) continue;
    world_.add_body_reaction(body, sum.force_W, sum.place_W, sum.moment_W);
  }
}

// What a gripper holds is the grip's own affair (GripperStep).
bool Reaction::is_gripping(int collider) const {
  return colliders_.placement(collider).drive >= 0;
}

Vec3 Reaction::place_of(int collider, const std::vector<ContactSum>& sums) const {
  // Where it was touched in the step before. Without a touch its own place is the best guess for
  // the first one.
  return sums[collider].contacts > 0 ? sums[collider].place_W
                                     : colliders_.placement(collider).X_WC.position;
}

// With W the inverse mass matrix of all contacts, each is solved by D_i = sum_j |W_ij| alone: D - W
// is positive semidefinite (Gershgorin), so that what they push together is never more than
// backward Euler allows. Contacts on the same collider are counted where they are found
// (ContactPoint::give), those on other colliders of the same robot as they were in the step before.
double Reaction::give_of(int i, const std::vector<ContactSum>& sums) const {
  // How far a gripper gives way is solved with the plant (GripperStep).
  if (is_gripping(i)) return 0.0;
  const Collider& own = colliders_.collider(i);
  const Vec3 place = place_of(i, sums);
  double inverse_inertia = 0.0;  // 1/kg
  for (int j = 0; j < colliders_.size(); ++j) {
    const Collider& other = colliders_.collider(j);
    const int contacts = i == j ? 1 : sums[j].contacts;
    if (other.body != own.body || contacts == 0 || is_gripping(j)) continue;
    if (own.body >= first_body_)
      inverse_inertia += contacts * world_.body_inverse_inertia(own.body, place);
    if (own.body == robot_body && robot_)
      inverse_inertia += contacts * robot_->robot().inverse_inertia(own.link, place, other.link,
                                                                    place_of(j, sums));
  }
  // A force acts for dt, and what it moves goes on for dt: m/N.
  return inverse_inertia * world_.dt() * world_.dt();
}

}  // namespace pedicel::simulation
