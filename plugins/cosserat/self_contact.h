#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cosserat/contact.h"

namespace pedicel::cosserat {

/// In ContactPoint::collider, the other shape of the same plant is this number plus its index.
/// Below it the numbers belong to things outside the plant.
constexpr int self_contact_base = 1 << 24;
constexpr bool is_self_contact(int collider) {
  return collider >= self_contact_base;
}

struct SelfContactSettings {
  double stiffness = 1.0e5;        ///< N/m, at most, stem against stem, > 0
  double fruit_stiffness = 1.0e4;  ///< N/m, at most, where one is a fruit, > 0
  double friction = 0.5;           ///< 1, Coulomb, >= 0
  double margin = 2.0e-4;          ///< m, two surfaces begin to push at this gap, > 0
};

/// Where two straight axes are nearest: fractions along them, 0 at the near end.
struct NearestFractions {
  double a = 0.5, b = 0.5;
};

/// Minimises |a(s) - b(t)|^2 + e ((s - 1/2)^2 + (t - 1/2)^2) over the unit square, with e = 1e-4
/// times the longer axis' length squared: unique and continuous also for parallel axes, where the
/// bare distance would throw the place from one end to the other. The second term costs at most e/2
/// in distance squared. An axis may be a point. Lengths in m, any frame.
NearestFractions nearest_fractions(const Vec3& start_a, const Vec3& along_a, const Vec3& start_b,
                                   const Vec3& along_b);

/// Pairs of boxes that overlap, found with a uniform grid: a box enters every cell that it touches,
/// and the pair belongs to the lowest cell that both share. Does not allocate once warm.
class OverlappingBoxes {
 public:
  /// Replaces `pairs` with all (i, j), i < j, in ascending order. Empty boxes overlap nothing.
  void find(std::span<const Eigen::AlignedBox3d> boxes, std::vector<std::pair<int, int>>& pairs);

 private:
  struct Entry {
    std::uint64_t cell;
    int box;
  };
  std::vector<Entry> entries_;
};

/// Contact of a plant with itself: capsule-capsule, capsule-sphere and sphere-sphere, with the
/// radius taken at the nearest places of the axes. Left out: shapes of elements that are at most
/// two joints (or welds) apart, and pairs nearer than the margin in the drawn shape.
///
/// Each pair gives two contacts, each against the virtual plane in the middle, which moves with the
/// mean of both surfaces: half of the gap and twice the stiffness, so that both sides carry the
/// force of one spring and momentum balances. The plane is frozen within an iteration, so only
/// block-diagonal parts of the Hessian arise.
///
/// Broad phase: the pairs that could meet are collected rarely, each element with a budget of
/// motion that grows with its speed, and kept until one has used its budget up. A find costs one
/// look at each element and a comparison of distances for each pair, against how far the two have
/// moved relative to each other in the step: what falls or swings together costs no more than that.
///
/// The price: what moves both sides together converges like Jacobi's method, by 1 / (1 + 2 k
/// dt^2/m) an iteration. A stiff spring would glue light parts to where they touched. So the spring
/// is progressive, F = k o (1 + o / margin) at an overlap o of the margins, with k = min(stiffness,
/// m / dt^2), m the lighter element's mass: what rests under its own weight sinks in by less than
/// the margin, and what is pressed harder meets a stiffer spring.
class SelfContact : public ContactSource {
 public:
  /// The model must be finished; it is only read here, not kept. Throws UsageError where a setting
  /// is out of its bounds.
  SelfContact(const RodModel& model, const SelfContactSettings& settings);

  void begin_step(const RodModel& model, const RodState& start, double dt) override;
  void find(const RodModel& model, const RodState& state, double dt,
            std::vector<ContactPoint>& found) override;

  /// Goes on with other settings; the margin stays. Throws UsageError where it is another.
  void change_settings(const SelfContactSettings& settings);

  /// What find() has done so far: how often it collected the pairs, and at how many it looked.
  struct Work {
    long collections = 0, pairs = 0;
  };
  const Work& work() const { return work_; }

 private:
  struct Axis {
    Vec3 near = Vec3::Zero(), along = Vec3::Zero();  // m, W
  };
  struct Body {                     // an element
    double lever = 0.0;             // m, from its middle to the farthest place of its shapes
    double middle_back = 0.0;       // m, of its middle
    Vec3 reference = Vec3::Zero();  // m, W, middle where the pairs were collected
    Quat reference_orientation = Quat::Identity();
    double budget = 0.0;         // m, the pairs hold while no place of it has moved by more
    Vec3 middle = Vec3::Zero();  // m, W, now
    Vec3 moved = Vec3::Zero();   // m, W, of the middle, in this step
    double turned = 0.0;         // m, in this step, of any place against the middle
  };
  struct Pair {
    int a = 0, b = 0;  // shapes, a < b
    int element_a = 0, element_b = 0;
  };
  struct Touch {
    double back_a = 0.0, back_b = 0.0;      // m
    double radius_a = 0.0, radius_b = 0.0;  // m
    Vec3 between_W = Vec3::Zero();          // m, from b's axis to a's
    double gap() const { return between_W.norm() - radius_a - radius_b; }
  };
  void move_bodies(const RodState& state);
  bool pairs_hold(const RodState& state) const;
  void collect_pairs(const RodModel& model, const RodState& state);
  static Axis axis_of(const CollisionShape& shape, const RodState& state);
  static Touch nearest(const RodModel& model, const RodState& state, int a, int b);
  void touch(const RodModel& model, const RodState& state, double dt, int a, int b,
             std::vector<ContactPoint>& found) const;
  Vec3 start_place(int element, const Vec3& arm_E) const;
  Vec3 motion(const RodState& state, int element, double back, const Vec3& outward_W) const;

  SelfContactSettings settings_;
  std::vector<Body> bodies_;                     // one an element
  std::vector<Pair> pairs_;                      // all that can meet within the budgets, ascending
  double extent_ = 0.0;                          // m, mean length of a shape
  std::vector<std::pair<int, int>> excluded_;    // shapes, ascending
  std::vector<std::pair<int, int>> candidates_;  // scratch
  std::vector<Eigen::AlignedBox3d> boxes_;       // scratch, m, W
  OverlappingBoxes overlapping_;
  Work work_;
  std::vector<Vec3> start_position_;
  std::vector<Quat> start_orientation_;
};

}  // namespace pedicel::cosserat
