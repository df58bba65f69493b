#pragma once

#include <optional>

#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/discrepancy/simulate/grip.h"
#include "plugins/discrepancy/simulate/moving_start.h"
#include "plugins/discrepancy/simulate/root_wrench.h"
#include "plugins/discrepancy/simulate/tracking.h"
#include "plugins/discrepancy/simulate/trial_run.h"

namespace pedicel::discrepancy {

/// One plant of a trial: how it begins, what is done to it, and what it did.
class TrialMember {
 public:
  /// Keeps references to all but the numbers. `steps`: of the longest run.
  TrialMember(const PlantMaker& maker, const Experiment& experiment, const Trial& trial,
              const RunMember& given, int steps);

  /// Finds the equilibrium of time 0. False where there is none: it is not healthy then.
  bool settle();
  /// The equilibrium of row `row` of a static series, from that of the row before, and its record.
  void settle_row(int row);

  /// The vibrations about the equilibrium, and how the drives of time 0 lead it.
  Modes modes(int count) const;
  /// Prepares a beginning in motion; without one it begins at rest.
  void prepare_start();
  /// The amplitudes anew, from what a run up to the window's end differs by from the samples.
  void learn();

  /// Adds it to `rods` as its next plant, as it begins, and records that. `rehearses`: neither
  /// springs to measured places nor fruits that come off take part.
  void enter(cosserat::RodSystem& rods, bool rehearses);
  /// What acts from `begin` to `end` (s).
  void drive(cosserat::RodSystem& rods, int plant, double begin, double end, bool jumps);
  void record(const cosserat::RodState& state, int row, double begin, double t);
  /// After a step, in which fruits came off: there the force has jumped.
  void record(const cosserat::RodState& state, std::span<const cosserat::DetachEvent> events,
              int row, double begin, double t);

  void fail() { result_.motion.healthy = false; }
  bool healthy() const { return result_.motion.healthy; }
  const cosserat::RodModel& model() const { return model_; }
  RunResult take();

 private:
  void hold_fruits();
  void take_off_fruits(cosserat::RodSystem& rods, int plant, double t);
  void came_off(int fruit, double t);
  void record_stalk(const cosserat::RodState& state, double t, int fruit);
  void record_force(const cosserat::RodState& state, double begin, double t);
  void forget_record();
  void fill_rows();
  RootMotion root_motion(double t) const;
  bool settle_at(double t);
  Eigen::VectorXd led(const Stiffness& stiffness) const;
  Stiffness stiffness() const;
  void place_supports(double begin, double t, std::vector<cosserat::Support>& supports) const;
  void place_loads(double begin, double end, const cosserat::RodState& state,
                   std::vector<cosserat::Load>& loads) const;

  const PlantMaker& maker_;
  const Experiment& experiment_;
  const Trial& trial_;
  const RunMember& given_;
  std::span<const PointForce> forces_;
  cosserat::RodModel model_;
  cosserat::RodState at_rest_;
  std::size_t file_supports_;
  Grip grip_;
  Tracking tracking_;
  bool rehearses_ = false;
  Guides* guides_ = nullptr;  // of the plant in the rods, theirs
  std::optional<MovingStart> start_;
  Eigen::VectorXd amplitudes_;
  std::vector<plant::PlacedPoint> markers_, load_places_, force_places_;
  std::vector<Quat> drawn_;  // W to E, of the markers' elements
  std::vector<Vec3> pulls_;
  std::vector<RootWrench::Wrench> wrenches_;
  RootWrench root_wrench_;
  bool restarted_ = false;                    // the step that is made is of first order
  std::vector<std::pair<double, int>> seen_;  // s, and the fruit that came off then
  RunResult result_;
};

}  // namespace pedicel::discrepancy
