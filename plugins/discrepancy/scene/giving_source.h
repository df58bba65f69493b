#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plugins/coupling/collider_source.h"
#include "plugins/discrepancy/scene/arm.h"

namespace pedicel::discrepancy {

/// m, from which an arm that gives way looks for contacts: it may come back to a plant that leaves
/// it.
inline constexpr double reach_back = 2.0e-3;

/// Where the links of an arm are that gives way between encoders and links, and how far that is.
struct GivingArm {
  const Arm* arm = nullptr;
  bool gives = false;
  Eigen::MatrixXd compliance;  ///< rad/(N m), of the joints within a step
  std::vector<Pose> links;  ///< X_WL, under what the plants exerted at the end of the step before
};

/// Contacts of a plant with an arm that gives way, within the step: the collider stands where the
/// forces of the step before push it, and goes on from there by its compliance times what the force
/// changes. The solver knows one compliance for all directions
/// (cosserat::ContactPoint::give), so gap and motion of a contact are told such that at the force
/// of the step before they are what they are. Place and force then agree in all directions as soon
/// as the force rests. Without that, force and place of a light plant and a soft joint throw each
/// other to and fro.
class GivingSource : public cosserat::ContactSource {
 public:
  /// Keeps references to all; the settings' margin only says from which gap on contacts are looked
  /// for, `margin` (m) from which they push. `body`: the number of the arm's colliders.
  GivingSource(const coupling::ColliderSet& colliders, const coupling::CouplingSettings& settings,
               double margin, int body, const GivingArm& arm);

  /// As if nothing gave way.
  coupling::ColliderSource& inner() { return inner_; }
  void cover(double from, double to) override {
    share_ = to - from;
    inner_.cover(from, to);
  }
  void begin_step(const cosserat::RodModel& model, const cosserat::RodState& start,
                  double dt) override {
    inner_.begin_step(model, start, dt);
  }
  void find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
            std::vector<cosserat::ContactPoint>& found) override;
  /// What the plant's contacts carried at the end of a step.
  void remember(std::span<const cosserat::ContactForce> forces);

 private:
  void give_way(const cosserat::RodModel& model, const cosserat::RodState& state,
                cosserat::ContactPoint& point) const;

  const coupling::ColliderSet& colliders_;
  coupling::ColliderSource inner_;
  double margin_;
  int body_;
  const GivingArm& arm_;
  double share_ = 1.0;                        // of the step that is being solved
  std::vector<Vec3> pushed_, pushed_before_;  // N, on each collider, W: at the last two steps' ends
  mutable robot::Jacobian jacobian_;
};

}  // namespace pedicel::discrepancy
