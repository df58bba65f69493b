// What a plant of a trial did, step by step.
#include <cmath>

#include "pedicel/cosserat/solver/detachment.h"
#include "pedicel/discrepancy/simulate/trial_member.h"

namespace pedicel::discrepancy {

void TrialMember::record(const cosserat::RodState& state, int row, double begin, double t) {
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
  if (tracking_.active() && !rehearses_)
    tracking_.record(model_, state, t, result_.tracking.row(row));
  for (std::size_t f = 0; f < result_.stalks.size(); ++f)
    if (!state.fruit_gone[f]) record_stalk(state, t, static_cast<int>(f));
}

void TrialMember::record(const cosserat::RodState& state,
                         std::span<const cosserat::DetachEvent> events, int row, double begin,
                         double t) {
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

void TrialMember::forget_record() {
  Motion& motion = result_.motion;
  motion.time.clear();
  motion.force_time.clear();
  motion.events.clear();
  pulls_.clear();
  wrenches_.clear();
  for (StalkLoads& stalk : result_.stalks) {
    stalk.time.clear();
    stalk.load.clear();
    stalk.came_off = StalkLoads().came_off;
  }
}

void TrialMember::fill_rows() {
  Motion& motion = result_.motion;
  motion.force.resize(motion.force_time.size(), 3);
  for (std::size_t r = 0; r < pulls_.size(); ++r) motion.force.row(r) = pulls_[r].transpose();
  if (!wrenches_.empty()) motion.wrench.resize(motion.force_time.size(), 6);
  for (std::size_t r = 0; r < wrenches_.size(); ++r)
    motion.wrench.row(r) = wrenches_[r].transpose();
}

RunResult TrialMember::take() {
  fill_rows();
  return std::move(result_);
}

void TrialMember::came_off(int fruit, double t) {
  result_.motion.events.push_back({t, "detached", model_.fruits[fruit].name});
  if (!result_.stalks.empty()) result_.stalks[fruit].came_off = t;
}

void TrialMember::record_stalk(const cosserat::RodState& state, double t, int fruit) {
  StalkLoads& stalk = result_.stalks[fruit];
  stalk.time.push_back(t);
  stalk.load.push_back(cosserat::stalk_numbers(model_, state, model_.fruits[fruit].element));
}

void TrialMember::record_force(const cosserat::RodState& state, double begin, double t) {
  const bool first = result_.motion.force_time.empty();
  result_.motion.force_time.push_back(t);
  pulls_.push_back(grip_.force(model_, state, begin, t));
  if (trial_.wrench.size() == 0) return;
  if (first || trial_.is_static) {
    const RootMotion root = root_motion(t);
    wrenches_.push_back(root_wrench_.begin(model_, state, t, start_ ? &root : nullptr));
  } else {
    wrenches_.push_back(root_wrench_.after(model_, state, t, restarted_));
  }
}

}  // namespace pedicel::discrepancy
