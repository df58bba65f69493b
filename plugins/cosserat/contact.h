#pragma once

#include <vector>

#include "cosserat/rod_state.h"

namespace pedicel {
class ThreadPool;
}

namespace pedicel::cosserat {

/// One place where a plant touches (or nearly touches) something that is not part of it.
struct ContactPoint {
  int shape = 0;        ///< index into RodModel::shapes
  int collider = 0;     ///< who is touched: an index that the source gives out, stable over steps
  double back = 0.0;    ///< m, place on the shape's element
  double radius = 0.0;  ///< m, of the shape there
  Vec3 normal_W = Vec3::UnitZ();  ///< unit, from the collider to the plant
  double gap = 0.0;               ///< m, between the surfaces; negative: they overlap
  /// m, W: how far the collider's surface moves, at this place, over the step being solved.
  Vec3 surface_motion_W = Vec3::Zero();
  double friction = 0.0;   ///< 1, Coulomb
  double stiffness = 0.0;  ///< N/m
  double margin = 0.0;     ///< m, the contact begins to push at this gap
  /// m/N: how far the collider, which is free to move, gives way over the step being solved for
  /// each newton on it, other contacts of this plant not counted. It acts in series with
  /// `stiffness`; `gap` is that before it gives way.
  double give = 0.0;
  /// Where two parts of a plant touch: of the spring that stiffens with the overlap of both.
  struct Stiffening {
    double stiffness = 0.0;  ///< N/m, where it begins
    double margin = 0.0;     ///< m, gap of the two surfaces where it begins
  };
  Stiffening stiffening;
};

/// What a contact point carried at the end of a step: the force ON THE PLANT.
struct ContactForce {
  ContactPoint point;
  Vec3 place_W = Vec3::Zero();       ///< m, on the plant's surface
  double normal = 0.0;               ///< N, >= 0
  Vec3 tangential_W = Vec3::Zero();  ///< N
  bool slipping = false;
};

/// Finds contacts. Called at the start of each iteration of a step, with the plant's current
/// iterate; the colliders are already at their poses of the END of the step. Must not allocate once
/// warm (`found` keeps its capacity).
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// The threads that find() may use until told otherwise; null: the caller's alone. What it finds
  /// must not depend on them.
  virtual void use(ThreadPool* /*pool*/) {}
  /// Which part of its motion over the whole step what is touched makes in the steps that follow:
  /// from share `from` of the way to share `to`. All of it, 0 to 1, until told otherwise.
  virtual void cover(double /*from*/, double /*to*/) {}
  /// Whether it finds nothing but where the plant touches itself: the two sides of each contact one
  /// after the other, with `stiffening`.
  virtual bool is_within_plant() const { return false; }
  /// A step begins at `start` (same time as the iterates that find() gets).
  virtual void begin_step(const RodModel& /*model*/, const RodState& /*start*/, double /*dt*/) {}
  virtual void find(const RodModel& model, const RodState& state, double dt,
                    std::vector<ContactPoint>& found) = 0;
};

}  // namespace pedicel::cosserat
