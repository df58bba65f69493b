#pragma once

#include <vector>

#include "engine/core/frames.h"
#include "plugins/cosserat/lanes/lanes.h"

namespace pedicel::cosserat {

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

/// A capsule (or a cone with round ends, or a sphere), in one line of a core's cache: the ends of
/// the axis and the radii there, linear in between.
struct alignas(64) Capsule {
  double near[3] = {}, radius_near = 0.0;  // m, W; m
  double far[3] = {}, radius_far = 0.0;

  Vec3 near_at() const { return {near[0], near[1], near[2]}; }
  Vec3 far_at() const { return {far[0], far[1], far[2]}; }
};
using Capsules = std::vector<Capsule>;

/// Pairs of capsules and, once measured, where their axes are nearest and the gap there. The arrays
/// keep their room, and have some beyond the last pair. In lines of the cache of their own, so that
/// threads which fill some side by side do not take them from each other.
struct alignas(64) CapsulePairs {
  std::vector<int> a, b;
  std::vector<double> at_a, at_b;  // fractions along the axes; not of pairs that were sifted
  std::vector<double> gap;         // m, negative where they overlap
  std::vector<float> closing;      // m a step, of pairs that collect_coming() added

  std::size_t size() const { return count_; }
  void clear() { count_ = 0; }
  void add(int first, int second) {
    make_room(1);
    a[count_] = first;
    b[count_] = second;
    ++count_;
  }
  /// Drops all pairs beyond the first ones, or takes up what was written into the room made.
  void resize(std::size_t count) { count_ = count; }
  /// For so many more, in whole vectors.
  void make_room(std::size_t more) {
    const std::size_t wanted = count_ + more + lane_count;
    if (wanted > a.size()) grow(wanted + wanted / 2);
  }
  /// For what measure() sets.
  void make_places();

 private:
  void grow(std::size_t room);

  std::size_t count_ = 0;
};

/// Sets at_a, at_b and gap of all pairs, several at a time: nearest_fractions() up to rounding.
void measure(const Capsules& capsules, CapsulePairs& pairs);

/// How far capsules have moved: from where to where, and no farther than `most` (m) each.
struct CapsuleMotion {
  const Capsules& start;
  const Capsules& now;
  double most;
};

/// Adds to `kept` those of the measured pairs whose gap is not above `open` + reach[a] + reach[b]
/// (m) + `steps` times what the two have moved against each other, at most, wherever on them: the
/// latter is `closing`, by which they may come nearer a step where they go on as they moved.
void collect_coming(const CapsuleMotion& motion, double open, double steps,
                    const std::vector<float>& reach, CapsulePairs& pairs, CapsulePairs& kept);
/// Adds to `kept` those of the pairs `first` to `end` so collected that `steps` steps may bring as
/// near as that, in their order.
void sift(const CapsulePairs& from, std::size_t first, std::size_t end, double open, double steps,
          const std::vector<float>& reach, CapsulePairs& kept);
/// Keeps those of the measured pairs whose gap is not above `open` + `times` (reach[a] +
/// reach[b]) (m) + what the two have moved against each other, at most, wherever on them.
void keep_meeting(const CapsuleMotion& motion, double open, double times,
                  const std::vector<float>& reach, CapsulePairs& pairs);
/// Lists those of the measured pairs that are not farther apart than `open` + what they have so
/// moved; returns how many.
std::size_t list_meeting(const CapsuleMotion& motion, double open, const CapsulePairs& pairs,
                         std::vector<int>& which);

}  // namespace pedicel::cosserat
