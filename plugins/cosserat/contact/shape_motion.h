#pragma once

#include <array>
#include <span>
#include <vector>

#include "plugins/cosserat/contact/capsules.h"
#include "plugins/cosserat/lanes/lanes.h"
#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// Where the collision shapes of a plant are, and bounds of how far they move, eight at a time.
///
/// What moves is bounded by the ends of the axes: no place of an axis moves farther than the
/// farther of its ends. Two references are kept, those of SelfContact's far and near list. Each has
/// a displacement bound (a Verlet skin), and a list holds while no end is farther than that from
/// where the reference has it. The near list's reference stands. The far list's goes on as each end
/// moved in the step in which it was taken: its predicted motion.
///
/// Calls for shapes `first` to `end`, multiples of lane_count up to room(), may be made at once for
/// different ones.
class ShapeMotion {
 public:
  struct Limits {
    double most = 0.0;                // m: more than this does not count of a step's motion
    double margin = 0.0, skin = 0.0;  // m, of the displacement bounds
    double near_share = 0.0, far_share = 0.0;  // 1, of the motion in this step, likewise
  };

  /// Some shapes, ascending; of many only the first ones.
  struct Deviating {
    std::array<int, 64> shapes;
    std::size_t count = 0;

    void add(int shape) {
      if (count < shapes.size()) shapes[count++] = shape;
    }
    std::span<const int> listed() const { return {shapes.data(), count}; }
  };

  /// All shapes stand as drawn. The model must be finished.
  ShapeMotion(const RodModel& model, const Limits& limits);

  std::size_t size() const { return count_; }
  std::size_t room() const { return now_.size(); }
  const Capsules& start() const { return start_; }
  const Capsules& now() const { return now_; }
  const Limits& limits() const { return limits_; }

  /// Makes the iterate the near list's reference. Sets displacement, reach and the near bound.
  /// Lists in `deviating` those that are farther from their predicted motion than their far bound
  /// allows for: the far list holds for all others that come within reach. A step's first update
  /// says where the step `begins`; then null.
  void update_near(const RodModel& model, const RodState* begins, const RodState& iterate,
                   std::size_t first, std::size_t end, Deviating& deviating);
  /// Whether the near list still holds at this iterate.
  bool validate_near(const RodModel& model, const RodState& iterate, std::size_t first,
                     std::size_t end);
  /// Makes the last reference of the near list the far list's, too, and the motion of this step its
  /// predicted motion, or, not `predicts`, none.
  void rebuild_far(std::size_t first, std::size_t end, bool predicts);

  /// Likewise for one shape alone, with so many times the bound.
  void rebuild_far(std::size_t shape, bool predicts, double times);
  /// Nothing is within its reach, until the next update.
  void forget_reach(std::size_t shape) { reach_[shape] = -1.0e30F; }

  /// m, by shape. Of an end in this step, at most.
  const std::vector<float>& displacement() const { return displacement_; }
  /// How much nearer than predicted a pair may come in this step, one's share.
  const std::vector<float>& reach() const { return reach_; }
  /// margin + near_share displacement
  const std::vector<float>& near_bound() const { return near_bound_; }
  /// skin + 2 margin + far_share displacement
  const std::vector<float>& far_bound() const { return far_bound_; }

  /// How far the ends of eight shapes have moved (m, W).
  struct alignas(32) EndsRow {
    float near[3][lane_count], far[3][lane_count];
  };
  /// The shapes' places on their elements as in CollisionShape (m); the first `stems` ones are on
  /// the elements of their own numbers.
  struct Places {
    std::size_t stems = 0;
    std::vector<float> back_near, back_far;
  };
  /// What the kernels write to; named as below.
  struct Arrays {
    Capsules &start, &now;
    std::vector<EndsRow>&predicted, &deviation, &reference;
    std::vector<float>&displacement, &reach, &near_bound, &far_bound;
  };

 private:
  Arrays arrays();

  std::size_t count_ = 0;  // what follows has room for whole vectors
  Limits limits_;
  Places places_;
  Capsules start_, now_;            // at the step's start, at the iterate
  std::vector<EndsRow> predicted_;  // of the far list, a step
  std::vector<EndsRow> deviation_;  // from there at the step's start
  std::vector<EndsRow> reference_;  // from the step's start to the near list's reference
  std::vector<float> displacement_, reach_, near_bound_, far_bound_;
};

}  // namespace pedicel::cosserat
