#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "plugins/cosserat/contact/capsules.h"
#include "plugins/cosserat/contact/contact.h"
#include "plugins/cosserat/contact/overlapping_boxes.h"
#include "plugins/cosserat/contact/shape_motion.h"
#include "plugins/cosserat/contact/self_contact_settings.h"
#include "plugins/cosserat/contact/touching_pairs.h"

namespace pedicel::cosserat {

/// In ContactPoint::collider, the other shape of the same plant is this number plus its index.
/// Below it the numbers belong to things outside the plant.
constexpr int self_contact_base = 1 << 24;
constexpr bool is_self_contact(int collider) {
  return collider >= self_contact_base;
}

constexpr double most_stiffening = 10.0;  ///< 1, of the progressive spring

/// Sets stiffness and margin of one side of a self-contact to the tangent of its progressive
/// spring: the same force and slope at its gap.
void take_tangent(ContactPoint& point);

/// N/m, of the spring between two parts where it begins: limited by what the lighter one's inertia
/// (`lighter`, kg) can follow in a step. A stiffer one would glue light parts to where they
/// touched.
double pair_stiffness(const SelfContactSettings& settings, bool is_fruit, double lighter,
                      double dt);

/// One of two parts that touch: its shape, and the place on it.
struct ContactSide {
  int shape = -1;
  double back = 0.0, radius = 0.0;  ///< m, as ContactPoint has them
};
/// Adds both sides of a pair, each against the plane in the middle, with the same force. `point`:
/// what both have in common. `normal_W`: from b to a.
void add_pair(ContactPoint point, const ContactSide& a, const ContactSide& b, const Vec3& normal_W,
              std::vector<ContactPoint>& found);

/// Contact of a plant with itself: capsule-capsule, capsule-sphere and sphere-sphere, with the
/// radius taken at the nearest places of the axes. Left out: shapes of elements that are at most
/// two joints (or welds) apart, and pairs nearer than the margin in the drawn shape; of two trees,
/// those that overlap there by more than the margin.
///
/// Each pair gives two contacts, each against the virtual plane in the middle, which moves with the
/// mean of both surfaces: half of the gap and twice the stiffness, so that both sides carry the
/// force of one spring and momentum balances. The plane is frozen within an iteration, so only
/// block-diagonal parts of the Hessian arise.
///
/// What moves is bounded by ShapeMotion, and a gap changes by no more than both shapes move. Three
/// sieves, each on what the one before left:
///   far list   may touch within some steps while no end deviates from its predicted motion by more
///              than a bound that grows with its speed; rebuilt rarely, from boxes. The few that
///              deviate further get a new prediction and lists of their own
///   near list  may touch in this step, whatever the iterations change within a displacement bound;
///              updated once or twice a step
///   contact    is nearer than the two have moved against each other in this step
///
/// The price: what moves both sides together converges like Jacobi's method, by 1 / (1 + 2 k
/// dt^2/m) an iteration. A stiff spring would glue light parts to where they touched. So the spring
/// is progressive, F = k o (1 + o / margin) at an overlap o of the margins, with k = min(stiffness,
/// m / dt^2), m the lighter element's mass: what rests under its own weight sinks in by less than
/// the margin, and what is pressed harder meets a stiffer spring.
class SelfContact : public ContactSource {
 public:
  /// The model must be finished; it is only read here, not kept. Where it is of several trees
  /// (JoinedModel), `trees` has the first element of each. Throws UsageError where a setting is out
  /// of its bounds.
  SelfContact(const RodModel& model, const SelfContactSettings& settings,
              std::span<const int> trees = {});

  void use(ThreadPool* pool) override { loop_.pool = pool; }
  bool is_within_plant() const override { return true; }
  /// `start` must stay as it is until the step's last find().
  void begin_step(const RodModel& model, const RodState& start, double dt) override;
  void find(const RodModel& model, const RodState& state, double dt,
            std::vector<ContactPoint>& found) override;
  void find_lists(const RodModel& model, const RodState& state, double dt,
                  ContactLists& found) override;

  /// Goes on with other settings; the margin stays. Throws UsageError where it is another.
  void change_settings(const SelfContactSettings& settings);

  /// What find() has done so far: how often it collected the far list, and how many pairs it
  /// measured.
  struct Work {
    long collections = 0, pairs = 0;
  };
  const Work& work() const { return work_; }

 private:
  void collect_left_out(const RodModel& model, std::span<const int> trees);
  bool update_lists(const RodModel& model, const RodState& state);
  template <class Task>
  int for_all_shapes(const Task& task);
  void collect_far();
  void make_box(std::size_t shape, int steps_left);
  CapsuleMotion moved_capsules() const;
  // How often a pair's motion of a step may have brought it nearer by the end of that step.
  double motions_until(int far_step) const { return far_stands_ ? 0.0 : far_step + 1.0; }
  void share_out_far();
  void add_contact(const RodModel& model, double dt, const TouchingRow& row, int lane,
                   std::vector<ContactPoint>& found) const;

  static constexpr std::size_t grain_size = 256;  // shapes, a thread

  using Pair = std::pair<int, int>;
  using Pairs = std::vector<Pair>;
  // What the parts of a loop need for themselves.
  struct Scratch {
    CapsulePairs near;  // this part of the near list
    CapsulePairs pairs;
    Pairs deviating_pairs;
    std::vector<int> meeting;
    long measured = 0;
    double work = 0.0;                 // of collecting its part of the near list
    bool holds = true;                 // of its shapes, the near list
    ShapeMotion::Deviating deviating;  // of its shapes
  };

  bool find_deviating(std::span<const Scratch> parts);
  void collect_near(int part);
  Pair far_pair(std::size_t i) const;
  void sift_far(const CapsulePairs& far, std::size_t begin, std::size_t end,
                Scratch& scratch) const;
  void keep_near(Scratch& scratch) const;
  void add_deviating(const Pair& begin, const Pair& end, Scratch& scratch) const;
  void touch_near(const RodModel& model, const RodState& state, double dt, Scratch& scratch,
                  std::vector<ContactPoint>& found) const;

  SelfContactSettings settings_;
  PartedLoop loop_;
  ShapeMotion motion_;
  // The far list is in parts; its gaps are those where its predictions begin. Pairs are ascending.
  std::array<CapsulePairs, PartedLoop::most_parts> far_;
  int far_parts_ = 0;
  // Where the parts of the near list begin in it (1, of its length).
  std::array<double, PartedLoop::most_parts + 1> near_begins_{};
  bool far_stands_ = true;                  // nothing is predicted to move
  int far_steps_ = 0, far_steps_most_ = 0;  // since then; for which it was made
  // Shapes that deviate from their predicted motion, ascending, and all that they may touch; what
  // the far list has of them does not count.
  std::vector<int> deviating_;
  CapsulePairs deviating_pairs_;
  bool step_begins_ = false;  // no list has been updated in it yet
  std::array<Scratch, PartedLoop::most_parts> scratch_;
  ContactLists found_;      // scratch
  OverlappingBoxes boxes_;  // m, W
  Work work_;
  const RodState* start_ = nullptr;  // of the step
};

}  // namespace pedicel::cosserat
