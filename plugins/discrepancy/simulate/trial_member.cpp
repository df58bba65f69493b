#include "plugins/discrepancy/simulate/trial_member.h"

#include <algorithm>
#include <cmath>

#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/detachment.h"
#include "plugins/cosserat/solver/equilibrium.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

namespace {

constexpr double same_time = 1.0e-9;  // s
constexpr double little = 1.0e-6;     // s, over which a path's speed is taken

Pose base_pose(const Trial& trial, double t, const Pose& drawn) {
  return {trial.base->position_at(t), trial.base->rotation_at(t) * drawn.rotation};
}

// The plant as a whole goes with its root.
void carry_to(const Pose& root, cosserat::RodState& state) {
  const Pose moved = root * state.root.inverse();
  state.root = state.previous_root = root;
  for (int e = 0; e < state.size(); ++e) {
    state.position[e] = moved * state.position[e];
    state.orientation[e] = (moved.rotation * state.orientation[e]).normalized();
  }
}

// As drawn, on the base where that is at time 0.
cosserat::RodState first_state(const cosserat::RodModel& model, const Trial& trial) {
  cosserat::RodState state = cosserat::drawn_state(model);
  if (trial.base) carry_to(base_pose(trial, 0.0, model.root), state);
  return state;
}

Vec3 speed_of(const DrivenPath& path, double t) {
  return (path.position_at(t + little) - path.position_at(t)) / little;
}

// A force on a place of an element, as Modes has rows.
void add_force(const cosserat::RodState& state, int element, double back, const Vec3& force,
               Eigen::VectorXd& forces) {
  const Vec3 arm = -back * (state.orientation[element] * Vec3::UnitZ());
  forces.segment<3>(6 * element) += force;
  forces.segment<3>(6 * element + 3) += arm.cross(force);
}

}  // namespace

TrialMember::TrialMember(const PlantMaker& maker, const Experiment& experiment, const Trial& trial,
                         const RunMember& given, int steps)
    : maker_(maker),
      experiment_(experiment),
      trial_(trial),
      given_(given),
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

bool TrialMember::settle() {
  const bool hangs =
      !cosserat::is_hung(model_) ||
      hang(model_, maker_.unladen(model_, trial_), first_state(model_, trial_), trial_.gravity);
  at_rest_ = first_state(model_, trial_);
  result_.motion.healthy = hangs && settle_at(0.0);
  return healthy();
}

bool TrialMember::settle_at(double t) {
  place_supports(t, t, model_.supports);
  Guides guides;
  grip_.add_guides(t, t, guides.all);
  cosserat::ContactSource* const source = &guides;
  std::vector<cosserat::Load> loads;
  // Point forces may depend on where the plant hangs.
  bool settled = true;
  for (int i = 0; i < (forces_.empty() ? 1 : 5) && settled; ++i) {
    place_loads(t, t, at_rest_, loads);
    settled = find_equilibrium(model_, at_rest_, trial_.gravity, loads,
                               std::span(&source, guides.all.empty() ? 0 : 1));
  }
  return settled;
}

void TrialMember::settle_row(int row) {
  if (row > 0) {
    const cosserat::RodState before = at_rest_;
    if (trial_.base) carry_to(base_pose(trial_, row, model_.root), at_rest_);
    if (!settle_at(row)) {
      at_rest_ = before;
      fail();
    }
  }
  record(at_rest_, row, row, row);
}

Stiffness TrialMember::stiffness() const {
  std::vector<cosserat::Load> loads;
  place_loads(0.0, 0.0, at_rest_, loads);
  std::vector<Guide> guides;
  grip_.add_guides(0.0, 0.0, guides);
  return Stiffness(model_, at_rest_, trial_.gravity, loads, guides);
}

Modes TrialMember::modes(int count) const {
  return modes_of(model_, at_rest_, stiffness(), count);
}

// The plant goes along with its base as a whole, and beside that as its holds pull it.
Eigen::VectorXd TrialMember::led(const Stiffness& stiffness) const {
  const Eigen::Index rows = 6 * static_cast<Eigen::Index>(model_.size());
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(rows), forces = Eigen::VectorXd::Zero(rows);
  const RootMotion root = root_motion(0.0);
  const auto carried = [&](const Vec3& place) -> Vec3 {
    return root.velocity + root.turning.cross(place - at_rest_.root.position);
  };
  for (int e = 0; e < model_.size(); ++e) {
    whole.segment<3>(6 * e) = carried(at_rest_.position[e]);
    whole.segment<3>(6 * e + 3) = root.turning;
  }
  bool is_led = false;
  for (const Hold& hold : trial_.holds) {
    if (!(hold.release > 0.0)) continue;
    const auto [element, back] = maker_.locate(hold.place);
    const Vec3 place = cosserat::point_on(model_, at_rest_, element, back);
    const Vec3 beside = speed_of(hold.path, 0.0) - carried(place);
    if (beside.isZero(0.0)) continue;
    is_led = true;
    const double k = hold.stiffness.value_or(rigid_stiffness);
    Vec3 force = hold.slides() ? Vec3(0, 0, 0) : Vec3(k * beside);
    for (const Vec3& axis : hold.axes) force += k * axis.dot(beside) * axis;
    add_force(at_rest_, element, back, force, forces);
  }
  if (!is_led) return whole;
  const auto moved = stiffness.solve(forces);
  return moved ? Eigen::VectorXd(whole + *moved) : whole;
}

void TrialMember::prepare_start() {
  start_.reset();
  if (!given_.start || given_.start->modes == 0 || !healthy()) return;
  const Stiffness stiff = stiffness();
  Modes modes = modes_of(model_, at_rest_, stiff, given_.start->modes);
  if (modes.size() < given_.start->modes) return fail();
  start_.emplace(model_, at_rest_, std::move(modes), led(stiff));
  amplitudes_ = Eigen::VectorXd::Zero(given_.start->amplitudes());
}

void TrialMember::learn() {
  if (!start_ || !healthy()) return;
  const std::vector<double>& time = trial_.markers.time;
  const auto end = std::upper_bound(time.begin(), time.end(), given_.start->window + same_time);
  std::vector<double> looked_at(time.begin(), end);
  const auto rows = static_cast<Eigen::Index>(looked_at.size());
  fill_rows();
  const Observed seen = observe(result_.motion, experiment_.markers, given_.effects, looked_at, {});
  // By sample, then marker, then axis.
  const Motion::Rows residual = trial_.markers.value.topRows(rows) - seen.markers;
  effects::SensorState sensor;
  for (const Marker& marker : experiment_.markers) sensor.markers.push_back(marker.name);
  sensor.offset.assign(experiment_.markers.size(), Vec3::Zero());
  for (const plant::Effect& effect : given_.effects) effects::apply_to_sensor(effect, sensor);
  for (double& t : looked_at) t -= sensor.delay;
  Eigen::MatrixXd swings = marker_swings(model_, start_->modes(), markers_, looked_at);
  for (Eigen::Index r = 0; r < swings.rows(); r += 3)
    swings.middleRows<3>(r) = (sensor.frame * swings.middleRows<3>(r)).eval();
  amplitudes_ += amplitude_step(*given_.start, start_->modes(), swings,
                                Eigen::Map<const Eigen::VectorXd>(residual.data(), residual.size()),
                                amplitudes_);
}

void TrialMember::enter(cosserat::RodSystem& rods, bool rehearses) {
  rehearses_ = rehearses;
  forget_record();
  cosserat::RodState state = at_rest_;
  if (start_) {
    Eigen::VectorXd amplitudes = amplitudes_;
    if (!rehearses)
      for (std::size_t i = 0; i < given_.start_shift.size(); ++i)
        amplitudes[static_cast<Eigen::Index>(i)] += given_.start_shift[i];
    state = start_->state(amplitudes);
  }
  result_.motion.began_moving = start_.has_value();
  const int plant = rods.add_plant(model_);
  guides_ = nullptr;
  if (grip_.has_guides()) {
    auto guides = std::make_unique<Guides>();
    guides_ = guides.get();
    rods.add_contact_source(plant, std::move(guides));
  }
  rods.set_state(plant, state);
  record(state, 0, 0.0, 0.0);
}

void TrialMember::drive(cosserat::RodSystem& rods, int plant, double begin, double end,
                        bool jumps) {
  cosserat::RodState& state = rods.edit_state(plant);
  if (!rehearses_) take_off_fruits(rods, plant, begin);
  if (jumps) {
    state.previous_dt = 0.0;
    record_force(state, begin, begin);
  }
  restarted_ = jumps;
  if (trial_.base) state.root = base_pose(trial_, end, model_.root);
  place_supports(begin, end, rods.supports(plant));
  if (guides_) {
    guides_->all.clear();
    grip_.add_guides(begin, end, guides_->all);
  }
  place_loads(begin, end, state, rods.loads(plant));
}

// They come off when they were seen to.
void TrialMember::hold_fruits() {
  for (int f = 0; f < static_cast<int>(model_.fruits.size()); ++f) {
    model_.fruits[f].thresholds = {};
    model_.fruits[f].law = {};
    for (const MeasuredEvent& event : trial_.events)
      if (event.is_detachment() && event.what == model_.fruits[f].name)
        seen_.emplace_back(event.time, f);
  }
}

void TrialMember::take_off_fruits(cosserat::RodSystem& rods, int plant, double t) {
  for (const auto& [time, fruit] : seen_) {
    const cosserat::RodState& state = rods.state(plant);
    if (time > t + same_time || state.fruit_gone[fruit]) continue;
    if (!state.alive[model_.fruits[fruit].element]) continue;
    cosserat::take_off(rods.edit_model(plant), rods.edit_state(plant), fruit);
    came_off(fruit, t);
  }
}

// Of a path that is linear between rows: as it has been up to now.
RootMotion TrialMember::root_motion(double t) const {
  if (!trial_.base || trial_.is_static) return {};
  const double from = std::max(0.0, t - little), to = from + little;
  const Quat turned = trial_.base->rotation_at(to) * trial_.base->rotation_at(from).conjugate();
  return {(trial_.base->position_at(to) - trial_.base->position_at(from)) / little,
          cosserat::log_map(turned) / little};
}

void TrialMember::place_supports(double begin, double t,
                                 std::vector<cosserat::Support>& supports) const {
  supports.resize(file_supports_);
  grip_.add_supports(begin, t, supports);
  if (!rehearses_) tracking_.add_supports(t, supports);
}

void TrialMember::place_loads(double begin, double end, const cosserat::RodState& state,
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
