#include "plugins/coupling/contact_report.h"

#include <algorithm>

#include "plugins/cosserat/contact/self_contact.h"

namespace pedicel::coupling {

namespace {

// While forces are added up, place_W holds the sum of normal force times place, and moment_W is
// about the world's origin.
// Moments about one fixed point can be added; those about each contact's own place cannot, and the
// common place is known only at the end.
void add_force(ContactSum& sum, const cosserat::ContactForce& contact, double sign) {
  // Contact forces are those on the plant. A collider gets them with the other sign, and so both
  // halves of a pair add up to zero.
  const Vec3 force_W = sign * (contact.normal * contact.point.normal_W + contact.tangential_W);
  ++sum.contacts;
  sum.normal += contact.normal;
  sum.tangential += contact.tangential_W.norm();
  sum.deepest = std::max(sum.deepest, -contact.point.gap);
  sum.slipping += contact.slipping;
  sum.force_W += force_W;
  sum.place_W += contact.normal * contact.place_W;
  sum.moment_W += contact.place_W.cross(force_W);
}

void finish(ContactSum& sum) {
  // Weighted with the normal forces, which are never negative: a mean of places then lies among
  // them. Weighted with vectors it could be anywhere.
  if (sum.normal > 0.0) sum.place_W /= sum.normal;
  // From the origin to the mean place. Force there and this moment are the whole of what acts; a
  // force alone would lose the twist that friction makes.
  sum.moment_W -= sum.place_W.cross(sum.force_W);
}

}  // namespace

void ContactReport::begin() {
  // Anew in each step: bodies that come off join the set while the world runs.
  by_collider_.assign(colliders_.size(), {});
  for (PlantSums& plant : by_plant_) {
    std::fill(plant.organs.begin(), plant.organs.end(), ContactSum{});
    std::fill(plant.fruits.begin(), plant.fruits.end(), ContactSum{});
  }
}

void ContactReport::add(int plant, const cosserat::RodModel& model,
                        std::span<const cosserat::ContactForce> forces) {
  // Allocates in the first step only, as the sums of organs and fruits below do.
  if (plant >= static_cast<int>(by_plant_.size())) by_plant_.resize(plant + 1);
  PlantSums& sums = by_plant_[plant];
  sums.organs.resize(model.organs.size());
  sums.fruits.resize(model.fruits.size());
  for (const cosserat::ContactForce& contact : forces) {
    const cosserat::CollisionShape& shape = model.shapes[contact.point.shape];
    const std::size_t organ = model.elements[shape.element].organ;
    if (organ < sums.organs.size()) add_force(sums.organs[organ], contact, 1.0);
    if (shape.fruit >= 0) add_force(sums.fruits[shape.fruit], contact, 1.0);
    // Contact of plants with themselves has numbers of its own that are no colliders of the set.
    // Organs count it: they feel it.
    if (!cosserat::is_self_contact(contact.point.collider))
      add_force(by_collider_[contact.point.collider], contact, -1.0);
  }
}

void ContactReport::end() {
  std::for_each(by_collider_.begin(), by_collider_.end(), finish);
  for (PlantSums& plant : by_plant_) {
    std::for_each(plant.organs.begin(), plant.organs.end(), finish);
    std::for_each(plant.fruits.begin(), plant.fruits.end(), finish);
  }
}

ContactSum ContactReport::sum_of_link(int body, int link) const {
  ContactSum total;
  for (int i = 0; i < static_cast<int>(by_collider_.size()); ++i) {
    if (colliders_.collider(i).body != body || colliders_.collider(i).link != link) continue;
    const ContactSum& one = by_collider_[i];
    total.contacts += one.contacts;
    total.normal += one.normal;
    total.tangential += one.tangential;
    total.deepest = std::max(total.deepest, one.deepest);
    total.slipping += one.slipping;
    total.force_W += one.force_W;
    // Colliders' sums are finished by now, so they are taken back to sums about the origin before
    // they are added, and finished once more.
    total.place_W += one.normal * one.place_W;
    total.moment_W += one.moment_W + one.place_W.cross(one.force_W);
  }
  finish(total);
  return total;
}

}  // namespace pedicel::coupling
