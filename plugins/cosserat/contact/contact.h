#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "plugins/cosserat/contact/contact_drive.h"
#include "plugins/cosserat/model/rod_state.h"

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
  /// Which of several places where one collider touches one shape; stable over steps. 0: the only
  /// one.
  int place = 0;
  /// Where two parts of a plant touch: of the spring that stiffens with the overlap of both.
  struct Stiffening {
    double stiffness = 0.0;  ///< N/m, where it begins
    double margin = 0.0;     ///< m, gap of the two surfaces where it begins
  };
  Stiffening stiffening;
};

/// Contacts in order, in lists one after another: several threads can fill one each, and nobody
/// copies what another one found.
class ContactLists {
 public:
  void clear() {
    for (List& list : lists_) list.points.clear();
    used_ = 1;
  }
  std::size_t size() const {
    std::size_t size = 0;
    for (const List& list : lists_) size += list.points.size();
    return size;
  }
  const ContactPoint& operator[](std::size_t i) const {
    std::size_t list = 0;
    for (; i >= lists_[list].points.size(); ++list) i -= lists_[list].points.size();
    return lists_[list].points[i];
  }
  /// So many more after all that were used. Returns the first one's number.
  std::size_t add(std::size_t count) {
    const std::size_t first = used_;
    used_ += count;
    if (lists_.size() < used_) lists_.resize(used_);
    return first;
  }
  std::vector<ContactPoint>& list(std::size_t number) { return lists_[number].points; }
  std::vector<ContactPoint>& last() { return list(used_ - 1); }

 private:
  struct alignas(64) List {  // in lines of the cache of their own
    std::vector<ContactPoint> points;
  };
  std::vector<List> lists_{1};
  std::size_t used_ = 1;
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
  /// The same, in the same order.
  virtual void find_lists(const RodModel& model, const RodState& state, double dt,
                          ContactLists& found) {
    find(model, state, dt, found.last());
  }
  /// Joints that press some of its colliders with a limited force in the step (or the part of it)
  /// that is being solved. At most one source of a plant has any; the position-based solver takes
  /// none into account.
  virtual std::span<const ContactDrive> drives() const { return {}; }
  /// One for each contact that the last find() appended; empty where there are no drives.
  virtual std::span<const DrivenContact> driven() const { return {}; }
  /// Where the step, or the part of it, left each of the drives, as far as this plant has it.
  virtual void end_drives(std::span<const DriveEnd> /*ends*/) {}
};

}  // namespace pedicel::cosserat
