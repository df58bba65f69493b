#include "pedicel/discrepancy/simulate/trial_run.h"

#include <cmath>

#include "pedicel/cosserat/solver/detachment.h"
#include "pedicel/cosserat/solver/rod_system.h"
#include "pedicel/discrepancy/simulate/equilibrium.h"
#include "pedicel/discrepancy/simulate/grip.h"
#include "pedicel/discrepancy/simulate/tracking.h"

namespace pedicel::discrepancy {

namespace {

constexpr double same_time = 1.0e-9;  // s

/// Newton's, of a step. Measured on releases of a stem of 0.6 m with two branches (90 elements,
/// steps of 1/960 s): 1e-7 leaves the markers within 5 um of the converged steps (rms 0.5 um). That
/// is still 0.2 nats of scatter in a fit's cost, which the derivatives feel (differences.cpp). The
/// elimination's factors are of single precision: on a stiff stem an iteration leaves a hundredth
/// there, so that 1e-8 stops with as much of it, where a fit ended a third of the way along its
/// valley.
cosserat::RodSettings solver_settings() {
  cosserat::RodSettings settings;
  settings.newton_iterations = 12;
  settings.tolerance = 1.0e-10;
  return settings;
}

bool failed(const cosserat::StepReport& report) {
  return report.errors & (cosserat::not_finite | cosserat::not_converged);
}

Pose base_pose(const Trial& trial, double t, const Pose& drawn) {
  return {trial.base->position_at(t), trial.base->rotation_at(t) * drawn.rotation};
}

// As drawn, on the base where that is at time 0.
cosserat::RodState first_state(const cosserat::RodModel& model, const Trial& trial) {
  cosserat::RodState state = cosserat::drawn_state(model);
  if (!trial.base) return state;
  state.root = state.previous_root = base_pose(trial, 0.0, model.root);
  const Pose moved = state.root * model.root.inverse();
  for (int e = 0; e < state.size(); ++e) {
    state.position[e] = moved * state.position[e];
    state.orientation[e] = (moved.rotation * state.orientation[e]).normalized();
  }
  return state;
}

/// One plant of the group.
class Member {
 public:
  Member(const PlantMaker& maker, const Experiment& experiment, const Trial& trial,
         const RunMember& given, int steps)
      : maker_(maker),
        trial_(trial),
        forces_(given.forces),
        model_(maker.make(trial, given.effects).model),
        file_supports_(model_.supports.size()),
        grip_(maker, model_, trial, given.effects),
        tracking_(maker, experiment, trial, given.tracking_stiffness) {
    for (const Marker& marker : experiment.markers) {
      markers_.push_back(maker.locate(marker.place));
      drawn_.push_back(model_.elements[markers_.back().element].drawn_rotation.conjugate());
    }
    for (const TimedLoad& load : trial.loads) load_places_.push_back(maker.locate(load.place));
    for (const PointForce& force : forces_) force_places_.push_back(maker.locate(force.place));
    const int count = static_cast<int>(markers_.size());
    Motion& motion = result_.motion;
    motion.position.resize(steps + 1, 3 * count);
    motion.velocity.resize(steps + 1, 3 * count);
    motion.turn.resize(steps + 1, 4 * count);
    if (tracking_.active()) result_.tracking.resize(steps + 1, 3 * count);
    if (records_detachments(experiment)) hold_fruits();
    if (given.records_stalks)
      for (const cosserat::Fruit& fruit : model_.fruits) {
        StalkLoads& stalk = result_.stalks.emplace_back();
        stalk.trial = trial.name;
        stalk.fruit = fruit.name;
      }
  }

  /// At rest at time 0, in `rods` as its next plant. False where there is no equilibrium.
  bool begin(cosserat::RodSystem& rods) {
    const bool hangs =
        !cosserat::is_hung(model_) ||
        hang(model_, maker_.unladen(model_, trial_), first_state(model_, trial_), trial_.gravity);
    place_supports(0.0, 0.0, model_.supports);
    cosserat::RodState state = first_state(model_, trial_);
    std::vector<cosserat::Load> loads;
    // Point forces may depend on where the plant hangs.
    bool settled = hangs;
    for (int i = 0; i < (forces_.empty() ? 1 : 5) && settled; ++i) {
      place_loads(0.0, 0.0, state, loads);
      settled = find_equilibrium(model_, state, trial_.gravity, loads);
    }
    const int plant = rods.add_plant(model_);
    rods.set_state(plant, state);
    record(state, 0, 0.0, 0.0);
    result_.motion.healthy = settled;
    return settled;
  }

  /// What acts from `begin` to `end` (s).
  void drive(cosserat::RodSystem& rods, int plant, double begin, double end, bool jumps) {
    cosserat::RodState& state = rods.edit_state(plant);
    take_off_fruits(rods, plant, begin);
    if (jumps) {
      state.previous_dt = 0.0;
      record_force(state, begin, begin);
    }
    if (trial_.base) state.root = base_pose(trial_, end, model_.root);
    place_supports(begin, end, rods.supports(plant));
    place_loads(begin, end, state, rods.loads(plant));
  }

  void record(const cosserat::RodState& state, int row, double begin, double t) {
    Motion& motion = result_.motion;
    motion.time.push_back(t);
    for (int m = 0; m < static_cast<int>(markers_.size()); ++m) {
      const auto [element, back] = markers_[m];
      const Quat turn = state.orientation[element] * drawn_[m];
      motion.position.row(row).segment<3>(3 * m) =
          cosserat::point_on(model_, state, element, back).transpose();
      motion.velocity.row(row).segment<3>(3 * m) =
          cosserat::velocity_on(model_, state, element, back).transpose();
      motion.turn.row(row).segment<4>(4 * m) = turn.coeffs().transpose();
    }
    record_force(state, begin, t);
    if (tracking_.active()) tracking_.record(model_, state, t, result_.tracking.row(row));
    for (std::size_t f = 0; f < result_.stalks.size(); ++f)
      if (!state.fruit_gone[f]) record_stalk(state, t, static_cast<int>(f));
  }

  /// After a step, in which fruits came off: there the force has jumped.
  void record(const cosserat::RodState& state, std::span<const cosserat::DetachEvent> events,
              int row, double begin, double t) {
    if (events.empty()) {
      record(state, row, begin, t);
      return;
    }
    cosserat::RodState before = state;
    for (const cosserat::DetachEvent& event : events) {
      before.alive[model_.fruits[event.fruit].element] = 1;
      before.fruit_gone[event.fruit] = 0;
    }
    record(before, row, begin, t);
    record_force(state, t, t);
    for (const cosserat::DetachEvent& event : events) came_off(event.fruit, t);
  }

  void fail() { result_.motion.healthy = false; }
  bool healthy() const { return result_.motion.healthy; }
  RunResult take() {
    Motion& motion = result_.motion;
    motion.force.resize(motion.force_time.size(), 3);
    for (std::size_t r = 0; r < pulls_.size(); ++r) motion.force.row(r) = pulls_[r].transpose();
    return std::move(result_);
  }

 private:
  // They come off when they were seen to.
  void hold_fruits() {
    for (int f = 0; f < static_cast<int>(model_.fruits.size()); ++f) {
      model_.fruits[f].thresholds = {};
      model_.fruits[f].law = {};
      for (const MeasuredEvent& event : trial_.events)
        if (event.is_detachment() && event.what == model_.fruits[f].name)
          seen_.emplace_back(event.time, f);
    }
  }

  void take_off_fruits(cosserat::RodSystem& rods, int plant, double t) {
    for (const auto& [time, fruit] : seen_) {
      const cosserat::RodState& state = rods.state(plant);
      if (time > t + same_time || state.fruit_gone[fruit]) continue;
      if (!state.alive[model_.fruits[fruit].element]) continue;
      cosserat::take_off(rods.edit_model(plant), rods.edit_state(plant), fruit);
      came_off(fruit, t);
    }
  }

  void came_off(int fruit, double t) {
    result_.motion.events.push_back({t, "detached", model_.fruits[fruit].name});
    if (!result_.stalks.empty()) result_.stalks[fruit].came_off = t;
  }

  void record_stalk(const cosserat::RodState& state, double t, int fruit) {
    const int e = model_.fruits[fruit].element;
    const cosserat::Strain strain = cosserat::strain_of(model_, state, e);
    const cosserat::JointLoad load = cosserat::joint_load(model_, state, e);
    StalkLoads& stalk = result_.stalks[fruit];
    stalk.time.push_back(t);
    stalk.load.push_back({strain.stretch.norm(), strain.bend.norm(), load.force.norm(),
                          load.moment.head<2>().norm(), std::abs(load.moment.z())});
  }

  void record_force(const cosserat::RodState& state, double begin, double t) {
    result_.motion.force_time.push_back(t);
    pulls_.push_back(grip_.force(state, begin, t));
  }

  void place_supports(double begin, double t, std::vector<cosserat::Support>& supports) const {
    supports.resize(file_supports_);
    grip_.add_supports(begin, t, supports);
    tracking_.add_supports(t, supports);
  }

  void place_loads(double begin, double end, const cosserat::RodState& state,
                   std::vector<cosserat::Load>& loads) const {
    loads.clear();
    const double middle = 0.5 * (begin + end);
    for (std::size_t i = 0; i < load_places_.size(); ++i) {
      const TimedLoad& load = trial_.loads[i];
      if (middle < load.from || middle >= load.to) continue;
      loads.push_back({load_places_[i].element, load_places_[i].back, load.force, Vec3::Zero()});
    }
    for (std::size_t i = 0; i < force_places_.size(); ++i) {
      if (!forces_[i].trial.empty() && forces_[i].trial != trial_.name) continue;
      const auto [element, back] = force_places_[i];
      const Vec3 force = forces_[i].law(begin, cosserat::point_on(model_, state, element, back),
                                        cosserat::velocity_on(model_, state, element, back));
      loads.push_back({element, back, force, Vec3::Zero()});
    }
  }

  const PlantMaker& maker_;
  const Trial& trial_;
  std::span<const PointForce> forces_;
  cosserat::RodModel model_;
  std::size_t file_supports_;
  Grip grip_;
  Tracking tracking_;
  std::vector<plant::PlacedPoint> markers_, load_places_, force_places_;
  std::vector<Quat> drawn_;  // W to E, of the markers' elements
  std::vector<Vec3> pulls_;
  std::vector<std::pair<double, int>> seen_;  // s, and the fruit that came off then
  RunResult result_;
};

}  // namespace

Eigen::MatrixXd tracking_at_samples(const RunResult& result, const Samples& markers) {
  Eigen::MatrixXd out;
  out.setConstant(markers.size(), markers.value.cols(), std::numeric_limits<double>::quiet_NaN());
  for (int s = 0; s < markers.size(); ++s) {
    const Interval at = find_interval(result.motion.time, markers.time[s]);
    if (at.row < 0) continue;
    out.row(s) = result.tracking.row(at.row);
    if (at.length > 0.0)
      out.row(s) = (1.0 - at.share) * out.row(s) + at.share * result.tracking.row(at.row + 1);
    out.row(s) = markers.value.row(s).array().isNaN().select(0.0, out.row(s));
  }
  return out;
}

std::vector<double> jumps_of(const Trial& trial, std::span<const plant::Effect> effects) {
  std::vector<double> times = slip_times(effects);
  for (const MeasuredEvent& event : trial.events)
    if (event.is_detachment()) times.push_back(event.time);
  for (const Hold& hold : trial.holds) times.push_back(hold.release);
  for (const TimedLoad& load : trial.loads) times.insert(times.end(), {load.from, load.to});
  return times;
}

std::vector<RunResult> run_trial(const PlantMaker& maker, const Experiment& experiment,
                                 const Trial& trial, const StepPlan& plan,
                                 std::span<const RunMember> given, const std::atomic<bool>& stop) {
  cosserat::RodSystem rods(solver_settings());
  std::vector<Member> members;
  members.reserve(given.size());
  int working = 0;
  for (const RunMember& one : given)
    working +=
        members.emplace_back(maker, experiment, trial, one, plan.steps()).begin(rods) ? 1 : 0;
  for (int k = 0; k < plan.steps() && working > 0; ++k) {
    const double begin = plan.time[k], end = plan.time[k + 1];
    for (int p = 0; p < rods.size(); ++p)
      members[p].drive(rods, p, begin, end, plan.restart[k] != 0);
    rods.step(plan.dt[k], trial.gravity);
    for (int p = 0; p < rods.size(); ++p) {
      Member& member = members[p];
      if (!member.healthy()) continue;
      if (failed(rods.report(p)) || stop) {
        member.fail();
        --working;
      } else {
        member.record(rods.state(p), rods.detached(p), k + 1, begin, end);
      }
    }
  }
  std::vector<RunResult> results;
  for (Member& member : members) results.push_back(member.take());
  return results;
}

}  // namespace pedicel::discrepancy
