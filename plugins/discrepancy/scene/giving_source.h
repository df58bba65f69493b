#pragma once

#include <memory>
#include <vector>

#include "pedicel/coupling/collider_source.h"
#include "pedicel/discrepancy/scene/arm.h"

namespace pedicel::discrepancy {

/// Where the links of an arm are that gives way between encoders and links, and how far that is.
struct GivingArm {
  const Arm* arm = nullptr;
  double compliance = 0.0;                ///< rad/(N m), of every joint; 0: it does not give way
  std::vector<Pose> links;                ///< X_WL, with what the plants did up to the step before
  std::vector<Pose> given, given_before;  ///< by link: from where it would be to where it is, W
};

/// Contacts of a plant with an arm that gives way, within the step: the collider stands where the
/// forces of the step before have pushed it, and goes on from there by its compliance times what
/// the force changes. Found contacts are told as if it stood where the encoders have it and gave
/// way from there (cosserat::ContactPoint::give). Without that, force and place of a light plant
/// and a soft joint throw each other to and fro.
class GivingSource : public cosserat::ContactSource {
 public:
  /// Keeps references to all; the settings' margin only says from which gap on contacts are looked
  /// for, `margin` (m) from which they push. `body`: the number of the arm's colliders.
  GivingSource(const coupling::ColliderSet& colliders, const coupling::CouplingSettings& settings,
               double margin, int body, const GivingArm& arm);

  void ignore_touching(const cosserat::RodModel& model, const cosserat::RodState& state) {
    inner_.ignore_touching(model, state);
  }
  void cover(double from, double to) override { inner_.cover(from, to); }
  void begin_step(const cosserat::RodModel& model, const cosserat::RodState& start,
                  double dt) override {
    inner_.begin_step(model, start, dt);
  }
  void find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
            std::vector<cosserat::ContactPoint>& found) override;

 private:
  void give_way(const cosserat::RodModel& model, const cosserat::RodState& state,
                cosserat::ContactPoint& point) const;

  const coupling::ColliderSet& colliders_;
  coupling::ColliderSource inner_;
  double margin_;
  int body_;
  const GivingArm& arm_;
  mutable robot::Jacobian jacobian_;
};

}  // namespace pedicel::discrepancy
