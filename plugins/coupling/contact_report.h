#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/coupling/collider.h"

namespace pedicel::coupling {

/// What touched something in a step, summed up.
struct ContactSum {
  int contacts = 0;
  double normal = 0.0;          ///< N, sum of the normal forces' sizes
  double tangential = 0.0;      ///< N, sum of the tangential forces' sizes
  double deepest = 0.0;         ///< m, deepest overlap
  int slipping = 0;             ///< of the contacts
  Vec3 force_W = Vec3::Zero();  ///< N: on the collider (colliders), on the plant (organs)
  /// m, W: where force_W acts, the mean of the contacts' places, weighted with their normal forces.
  Vec3 place_W = Vec3::Zero();
  Vec3 moment_W = Vec3::Zero();  ///< N m about place_W, on the same body as force_W
};

/// Forces between plants and colliders as numbers, one step at a time: begin(), add() for each
/// plant, end(). Does not allocate once warm.
class ContactReport {
 public:
  explicit ContactReport(const ColliderSet& colliders) : colliders_(colliders) {}

  void begin();
  /// `plant` counts from 0. Forces as RodSolver::contact_forces() gives them; self-contact counts
  /// for the organs only.
  void add(int plant, const cosserat::RodModel& model,
           std::span<const cosserat::ContactForce> forces);
  void end();
  /// Room for colliders that were added to the set since begin(): nothing touches them.
  void add_colliders() { by_collider_.resize(colliders_.size()); }

  /// One a collider. Colliders of one link are added up with sum_of_link().
  const std::vector<ContactSum>& colliders() const { return by_collider_; }
  /// One an organ of a plant (RodModel::organs), with its contacts with itself.
  const std::vector<ContactSum>& organs(int plant) const { return by_plant_[plant].organs; }
  /// One a fruit of a plant; its organ counts it, too.
  const std::vector<ContactSum>& fruits(int plant) const { return by_plant_[plant].fruits; }
  /// The reaction on a link: for two-way coupling, force_W at place_W and moment_W.
  ContactSum sum_of_link(int body, int link) const;

 private:
  struct PlantSums {
    std::vector<ContactSum> organs, fruits;
  };
  const ColliderSet& colliders_;
  std::vector<ContactSum> by_collider_;
  std::vector<PlantSums> by_plant_;
};

}  // namespace pedicel::coupling
