#include "pedicel/coupling/contact_report.h"

#include <algorithm>

#include "pedicel/cosserat/contact/self_contact.h"

namespace pedicel::coupling {

namespace {

// While forces are added up, place_W holds the sum of normal force times place, and moment_W is
// about the world's origin.
void add_force(ContactSum& sum, const cosserat::ContactForce& contact, double sign) {
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
  if (sum.normal > 0.0) sum.place_W /= sum.normal;
  sum.moment_W -= sum.place_W.cross(sum.force_W);
}

}  // namespace

void ContactReport::begin() {
  by_collider_.assign(colliders_.size(), {});
  for (PlantSums& plant : by_plant_) {
    std::fill(plant.organs.begin(), plant.organs.end(), ContactSum{});
    std::fill(plant.fruits.begin(), plant.fruits.end(), ContactSum{});
  }
}

void ContactReport::add(int plant, const cosserat::RodModel& model,
                        std::span<const cosserat::ContactForce> forces) {
  if (plant >= static_cast<int>(by_plant_.size())) by_plant_.resize(plant + 1);
  PlantSums& sums = by_plant_[plant];
  sums.organs.resize(model.organs.size());
  sums.fruits.resize(model.fruits.size());
  for (const cosserat::ContactForce& contact : forces) {
    const cosserat::CollisionShape& shape = model.shapes[contact.point.shape];
    const std::size_t organ = model.elements[shape.element].organ;
    if (organ < sums.organs.size()) add_force(sums.organs[organ], contact, 1.0);
    if (shape.fruit >= 0) add_force(sums.fruits[shape.fruit], contact, 1.0);
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
    total.place_W += one.normal * one.place_W;
    total.moment_W += one.moment_W + one.place_W.cross(one.force_W);
  }
  finish(total);
  return total;
}

}  // namespace pedicel::coupling
