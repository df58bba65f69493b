#include "app/steer/steered_run.h"

#include <cmath>

#include "app/report/run_state.h"
#include "app/session/document/settings_check.h"
#include "app/steer/tool_reach.h"
#include "engine/core/check.h"
#include "engine/io/csv.h"
#include "engine/world/settings.h"

namespace pedicel::app {

namespace {

Vec3 vec3_at(const std::vector<double>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

void expect(const Act& act, std::size_t count, const char* what) {
  if (act.numbers.size() != count)
    throw UsageError(std::to_string(act.numbers.size()) + " numbers, expected " +
                     std::to_string(count) + ": " + what);
}

void expect_finite(const Act& act) {
  for (const double number : act.numbers)
    if (!std::isfinite(number)) throw UsageError("a number is not finite, expected finite ones");
}

simulation::RobotControl& led_robot(simulation::Simulation& simulation) {
  robot_of(simulation);
  return *simulation.robot();
}

}  // namespace

SteeredScene::SteeredScene(Document opened, std::vector<std::string> wanted_packages)
    : files(opened), document(std::move(opened)), packages(std::move(wanted_packages)) {
  files.settings.clear();
  build();
}

void SteeredScene::build() {
  check_settings(document);
  assets = std::make_shared<const simulation::SceneAssets>(scene_of(document),
                                                           options_of(document, packages));
}

std::shared_ptr<const SteeredScene> SteeredScene::with(const Settings& settings) const {
  auto changed = std::make_shared<SteeredScene>(*this);
  for (const auto& [key, text] : settings) {
    std::erase_if(changed->document.settings, [&](const auto& one) { return one.first == key; });
    changed->document.settings.emplace_back(key, text);
  }
  changed->build();
  return changed;
}

SteeredRun::SteeredRun(std::shared_ptr<const SteeredScene> scene)
    : made_(std::move(scene)), scene_(made_) {
  begin();
}

void SteeredRun::begin() {
  // The forces are of the simulation that goes.
  forces_.reset();
  simulation_ = std::make_unique<simulation::Simulation>(scene_->assets);
  forces_ = std::make_unique<OrganForces>(*simulation_);
  simulation_->world().add(*forces_);
  now_ = scene_;
  model_ = model_hash(*simulation_);
  acts_.clear();
  ++generation_;
}

void SteeredRun::reset(const SteeredScene::Settings& settings) {
  scene_ = made_;
  if (settings.empty()) return begin();
  scene_ = made_->with(settings);
  const RowLayout before(*simulation_);
  begin();
  if (RowLayout(*simulation_) == before) return;
  scene_ = made_;
  begin();
  throw UsageError(
      "reset: these settings make other segments, expected a simulation of its own for them");
}

void SteeredRun::act(Act act) {
  act.step = steps();
  carry_out(act);
  acts_.push_back(std::move(act));
}

void SteeredRun::carry_out(const Act& act) {
  switch (act.kind) {
    case Act::Kind::position:
    case Act::Kind::velocity:
    case Act::Kind::torque:
      return set_targets(act);
    case Act::Kind::go_to: {
      simulation::RobotControl& robot = led_robot(*simulation_);
      expect(act, static_cast<std::size_t>(robot.robot().model().dofs()), "one a joint");
      expect_finite(act);
      return robot.go_to(
          Eigen::Map<const Eigen::VectorXd>(act.numbers.data(), robot.robot().model().dofs()));
    }
    case Act::Kind::force:
      expect(act, 7, "a place, a force and a moment");
      expect_finite(act);
      return forces_->set(act.name, act.numbers[0], vec3_at(act.numbers, 1),
                          vec3_at(act.numbers, 4));
    case Act::Kind::no_forces:
      return forces_->clear();
    case Act::Kind::push: {
      expect(act, 6, "a force and a point");
      expect_finite(act);
      const int body = simulation_->world().body_index(act.name);
      if (body < 0)
        throw UsageError("no body " + in_quotes(act.name) + ", expected one of the scene's");
      return simulation_->world().push_body(body, vec3_at(act.numbers, 0), vec3_at(act.numbers, 3));
    }
    case Act::Kind::cut:
      expect(act, 1, "a place");
      expect_finite(act);
      return simulation_->cutting().cut(act.name, act.numbers[0]);
    case Act::Kind::set: {
      const auto [key, value] = world::split_assignment(act.name);
      return change(key, value);
    }
  }
}

void SteeredRun::set_targets(const Act& act) {
  simulation::RobotControl& robot = led_robot(*simulation_);
  const int dofs = robot.robot().model().dofs();
  expect(act, static_cast<std::size_t>(dofs), "one a joint");
  for (const double number : act.numbers)
    if (std::isinf(number)) throw UsageError("a target is infinite, expected finite ones");
  robot::JointMotors& motors = robot.robot().motors();
  if (!robot.led_by_motors()) {
    // Whoever is told nothing stays where it is.
    for (int i = 0; i < dofs; ++i) motors.set_position_target(i, robot.robot().positions()[i]);
    robot.lead_by_motors();
  }
  for (int i = 0; i < dofs; ++i) {
    const double value = act.numbers[static_cast<std::size_t>(i)];
    if (std::isnan(value)) continue;
    if (act.kind == Act::Kind::position) motors.set_position_target(i, value);
    if (act.kind == Act::Kind::velocity) motors.set_velocity_target(i, value);
    if (act.kind == Act::Kind::torque) motors.set_torque(i, value);
  }
}

void SteeredRun::change(const std::string& key, const std::string& text) {
  const std::shared_ptr<const SteeredScene> changed = now_->with({{key, text}});
  if (!simulation_->can_change_to(*changed->assets))
    throw UsageError(key +
                     ": changes what is set up once, expected it when the simulation is made "
                     "or reset");
  simulation_->change_to(changed->assets);
  now_ = changed;
}

bool SteeredRun::step() {
  if (failed()) return false;
  simulation_->step();
  return !failed();
}

bool SteeredRun::failed() const {
  return (simulation_->world().report().errors & world::fatal_errors) != 0;
}

std::string SteeredRun::failure() const {
  if (!failed()) return {};
  const world::WorldReport& report = simulation_->world().report();
  std::string text = "unstable at " + io::format_number(report.time, 6) + " s: ";
  for (const std::string& part : {report.culprit, report.cause})
    if (!part.empty()) text += part + ": ";
  return text + world::remedy(static_cast<world::WorldError>(report.errors & world::fatal_errors));
}

SavedRun SteeredRun::save() const {
  return {model_, steps(), simulation_->state_hash(), acts_};
}

bool SteeredRun::leads_through_here(const SavedRun& saved) const {
  if (saved.steps < steps() || saved.acts.size() < acts_.size()) return false;
  for (std::size_t i = 0; i < acts_.size(); ++i)
    if (!(saved.acts[i] == acts_[i])) return false;
  // What the other did before this step, and this run did not, is not made up for.
  return saved.acts.size() == acts_.size() || saved.acts[acts_.size()].step >= steps();
}

void SteeredRun::restore(const SavedRun& saved) {
  if (saved.model != model_)
    throw UsageError(
        "restore: saved of a scene with other plants or settings, expected the same scene with the "
        "same settings");
  if (!leads_through_here(saved)) begin();
  for (;;) {
    while (acts_.size() < saved.acts.size() && saved.acts[acts_.size()].step <= steps())
      act(saved.acts[acts_.size()]);
    if (steps() >= saved.steps) break;
    if (!step()) break;
  }
  if (steps() != saved.steps || simulation_->state_hash() != saved.state)
    throw UsageError(
        "restore: the run does not come to this state again; robot or files of the scene are "
        "others now, or the program is");
}

}  // namespace pedicel::app
