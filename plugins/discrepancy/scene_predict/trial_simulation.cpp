#include "plugins/discrepancy/scene_predict/trial_simulation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "plugins/cosserat/solver/equilibrium.h"
#include "plugins/cosserat/solver/joined_systems.h"
#include "plugins/discrepancy/scene/state_changes.h"
#include "plugins/discrepancy/simulate/variant_plant.h"
#include "plugins/simulation/giving_robot.h"
#include "plugins/simulation/plants/rod_options.h"
#include "plugins/simulation/plants/wind_field.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/scene_contacts.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::discrepancy {

namespace {

using simulation::SceneAssets;

// As for trials of plants (trial_run.cpp), but for contact, whose iterations end where they find
// no better place.
cosserat::RodSettings solver_settings(const Experiment& experiment, const SceneNumerics& numerics) {
  cosserat::RodSettings settings;
  if (numerics.as_run) {
    Diagnostics read_before;
    simulation::apply_rod_settings(experiment.scene.rods, settings, read_before);
    return settings;
  }
  settings.newton_iterations = 12;
  settings.tolerance = numerics.tolerance;
  return settings;
}

/// The scene without what leads its robot and what looks at it: readings and recorder do that.
world::Scene scene_of(const Experiment& experiment, double dt) {
  world::Scene scene = experiment.scene;
  scene.dt = dt;
  scene.threads = 1;
  scene.robot->waypoints.clear();
  scene.robot->trajectory.clear();
  scene.robot->recorded.clear();
  scene.instruments.clear();
  scene.cameras.clear();
  scene.effects.clear();  // they are in the member's state
  return scene;
}

/// What one variant's simulation is made of.
class Parts {
 public:
  Parts(const Experiment& experiment, const Trial& trial,
        std::span<const std::unique_ptr<PlantMaker>> makers, const simulation::ShapeFields& fields,
        const SceneNumerics& numerics, const SceneMember& member)
      : experiment_(experiment),
        trial_(trial),
        makers_(makers),
        numerics_(numerics),
        member_(member),
        assets_(std::make_shared<SceneAssets>(scene_of(experiment, numerics.dt))) {
    assets_->rods = solver_settings(experiment, numerics);
    assets_->coupling = member.state->coupling;
    assets_->coupling.two_way = false;
    if (!numerics.as_run) assets_->coupling.margin = numerics.margin;
    assets_->robot = member.arm->description();
    assets_->robot_fields = fields;
    assets_->effects.emplace();
    assets_->effects->state = *member.state;
    assets_->readings = [&member](double t, Eigen::VectorXd& q, Eigen::VectorXd& qd) {
      const JointPath::Point point = arm_at(member, t);
      q = point.q;
      qd = point.qd;
    };
    assets_->loose_fruits = numerics.as_run;
    add_grasps();
    for (std::size_t p = 0; p < makers.size(); ++p) add_plant(p);
  }

  const std::shared_ptr<SceneAssets>& assets() const { return assets_; }
  /// False where a plant finds no rest to begin from.
  bool rests() const { return rests_; }

 private:
  void add_grasps() {
    for (const MeasuredEvent& event : trial_.events) {
      if (event.event != "grasped" && event.event != "released") continue;
      const int named = experiment_.robot.link(event.by);
      assets_->grasps.push_back({event.time, event.event == "grasped", event.what,
                                 named >= 0 ? named : member_.arm->tool()});
    }
  }

  void add_plant(std::size_t p) {
    std::vector<plant::Effect> own;
    for (const plant::Effect& effect : member_.effects) {
      const auto named = effect.words.find("plant");
      if (named == effect.words.end() || named->second == experiment_.plants[p].name)
        own.push_back(effect);
    }
    const Trial masses = masses_of(static_cast<int>(p));
    plant::BuiltPlant built = makers_[p]->make(masses, own);
    cosserat::RodModel& model = built.model;
    const SceneState::Plant& changes = member_.state->plants[p];
    change_plant(model, changes);
    const Pose by = moved_plant(model.root.position, changes);
    for (cosserat::Support& support : model.supports) {
      support.position = by * support.position;
      support.rotation = by.rotation * support.rotation;
    }
    simulation::PlantInfo info;
    info.name = experiment_.plants[p].name;
    for (const auto& triangle : built.blades) {
      simulation::Blade& blade = info.blades.emplace_back();
      for (std::size_t c = 0; c < 3; ++c)
        blade[c] = {triangle.corners[c].element, triangle.corners[c].back};
    }
    if (experiment_.scene.wind) simulation::expose_to_wind(model, info.blades);
    assets_->states.push_back(first_state(p, model, masses, by));
    assets_->models.push_back(std::move(model));
    assets_->plants.push_back(std::move(info));
  }

  // A run begins as drawn, and what was measured at rest.
  cosserat::RodState first_state(std::size_t p, cosserat::RodModel& model, const Trial& masses,
                                 const Pose& by) {
    cosserat::RodState state = cosserat::drawn_state(model);
    state.root = state.previous_root = by * model.root;
    for (int e = 0; e < state.size(); ++e) {
      state.position[e] = by * state.position[e];
      state.orientation[e] = (by.rotation * state.orientation[e]).normalized();
    }
    if (numerics_.as_run) return state;
    const Vec3& gravity = experiment_.scene.gravity;
    if (cosserat::is_hung(model) &&
        !hang(model, makers_[p]->unladen(model, masses), state, gravity))
      rests_ = false;
    if (!find_equilibrium(model, state, gravity, {})) rests_ = false;
    return state;
  }

  Trial masses_of(int plant) const {
    Trial trial;
    trial.clock = trial_.clock;
    for (const Trial::Mass& mass : trial_.masses)
      if (mass.plant == plant) trial.masses.push_back(mass);
    return trial;
  }

  const Experiment& experiment_;
  const Trial& trial_;
  std::span<const std::unique_ptr<PlantMaker>> makers_;
  const SceneNumerics& numerics_;
  const SceneMember& member_;
  std::shared_ptr<SceneAssets> assets_;
  bool rests_ = true;
};

/// One variant of a trial while it runs, and what is noted of it.
class MemberRun {
 public:
  MemberRun(const Experiment& experiment, const Trial& trial,
            std::span<const std::unique_ptr<PlantMaker>> makers,
            const simulation::ShapeFields& fields, const SceneNumerics& numerics,
            const SceneMember& member, int steps)
      : experiment_(experiment), member_(member) {
    const Parts parts(experiment, trial, makers, fields, numerics, member);
    motion_.healthy = parts.rests();
    simulation_.emplace(parts.assets());
    find_places(makers);
    for (const WrenchSensor& sensor : experiment.wrenches)
      sensors_.emplace_back(member.arm->description(), sensor.link);
    const long markers = static_cast<long>(experiment.markers.size());
    const long dofs = member.arm->model().dofs();
    motion_.position.setZero(steps + 1, 3 * markers);
    motion_.velocity.setZero(steps + 1, 3 * markers);
    motion_.turn.setZero(steps + 1, 4 * markers);
    motion_.contact.setZero(steps + 1, 6 * static_cast<long>(experiment.wrenches.size()));
    motion_.effort.setZero(steps + 1, dofs);
    if (simulation_->giving()) motion_.given.setZero(steps + 1, 3 * dofs);
    note_markers(0, 0.0);
  }

  simulation::Simulation& simulation() { return *simulation_; }

  /// What acts from outside in the step that ends at `t`.
  void push(double t) {
    for (std::size_t f = 0; f < member_.forces.size(); ++f) {
      const SceneForce& force = member_.forces[f];
      const bool acts = t >= force.from && t <= force.until &&
                        simulation_->rods()
                            .state(force.plant)
                            .alive[simulation_->rods().loads(force.plant)[slots_[f]].element];
      const double share =
          force.rise > 0.0 ? std::clamp((t - force.from) / force.rise, 0.0, 1.0) : 1.0;
      simulation_->rods().loads(force.plant)[slots_[f]].force_W =
          acts ? Vec3(share * force.force) : Vec3(Vec3::Zero());
    }
  }

  void note(int row, double t) {
    take_events(t);
    if (!judge()) return;
    note_markers(row, t);
    note_contact(row);
  }

  void fail() { motion_.healthy = false; }
  bool healthy() const { return motion_.healthy; }
  SceneMotion take() { return std::move(motion_); }

 private:
  void find_places(std::span<const std::unique_ptr<PlantMaker>> makers) {
    for (const SceneForce& force : member_.forces) {
      const plant::PlacedPoint at =
          makers[static_cast<std::size_t>(force.plant)]->locate(force.place);
      auto& loads = simulation_->rods().loads(force.plant);
      slots_.push_back(loads.size());
      loads.push_back({at.element, at.back, Vec3::Zero(), Vec3::Zero()});
    }
    for (const Marker& marker : experiment_.markers) {
      plant::PlacedPoint& place = places_.emplace_back();
      if (marker.plant < 0) continue;
      if (marker.fruit < 0) {
        place = makers[static_cast<std::size_t>(marker.plant)]->locate(marker.place);
      } else {
        const cosserat::Fruit& fruit =
            simulation_->rods().model(marker.plant).fruits[static_cast<std::size_t>(marker.fruit)];
        place = {fruit.element, fruit.back};
      }
    }
  }

  void note_markers(int row, double t) {
    motion_.time.push_back(t);
    for (std::size_t m = 0; m < experiment_.markers.size(); ++m) {
      const int p = experiment_.markers[m].plant;
      if (p < 0) continue;
      const cosserat::RodModel& model = simulation_->rods().model(p);
      const cosserat::RodState& state = simulation_->rods().state(p);
      const auto [element, back] = places_[m];
      const auto at = static_cast<long>(m);
      motion_.position.row(row).segment<3>(3 * at) =
          cosserat::point_on(model, state, element, back).transpose();
      motion_.velocity.row(row).segment<3>(3 * at) =
          cosserat::velocity_on(model, state, element, back).transpose();
      motion_.turn.row(row).segment<4>(4 * at) =
          (state.orientation[element] * model.elements[element].drawn_rotation.conjugate())
              .coeffs()
              .transpose();
    }
  }

  void note_contact(int row) {
    const simulation::SceneContacts& contacts = simulation_->contacts();
    for (std::size_t w = 0; w < experiment_.wrenches.size(); ++w)
      motion_.contact.row(row).segment<6>(6 * static_cast<long>(w)) =
          sensors_[w].felt(simulation_->robot()->link_poses(), contacts.link_forces()).transpose();
    motion_.effort.row(row) = contacts.effort().transpose();
    // A stem may lean on the arm from the start, and before the first step no force is known.
    if (row == 1) {
      motion_.contact.row(0) = motion_.contact.row(1);
      motion_.effort.row(0) = motion_.effort.row(1);
    }
    if (simulation_->giving()) motion_.given.row(row) = simulation_->giving()->row();
  }

  bool judge() {
    for (int p = 0; p < simulation_->rods().size(); ++p)
      if (simulation_->rods().report(p).errors & cosserat::not_finite) motion_.healthy = false;
    return motion_.healthy;
  }

  void take_events(double t) {
    for (int p = 0; p < simulation_->rods().size(); ++p)
      for (const cosserat::DetachEvent& event : simulation_->rods().detached(p))
        motion_.events.push_back(
            {t, "detached", simulation_->rods().model(p).fruits[event.fruit].name, ""});
  }

  const Experiment& experiment_;
  const SceneMember& member_;
  std::vector<robot::CarriedLinks> sensors_;  // of the experiment's wrenches
  std::optional<simulation::Simulation> simulation_;
  std::vector<plant::PlacedPoint> places_;  // of the markers
  std::vector<std::size_t> slots_;          // of outside forces among their plant's loads
  SceneMotion motion_;
};

/// Steps all variants once. Those whose plants do not feel each other and hang on no string are
/// solved together, which is faster and gives the same bits.
class Stepper {
 public:
  Stepper(const std::vector<std::unique_ptr<MemberRun>>& runs, const cosserat::RodSettings& rods,
          const Experiment& experiment, bool touching)
      : runs_(runs) {
    if (touching || !experiment.scene.ties.empty() || rods.solver != cosserat::SolverKind::direct)
      return;
    std::vector<cosserat::RodSystem*> systems;
    systems.reserve(runs.size());
    for (const auto& run : runs) systems.push_back(&run->simulation().rods());
    joined_.emplace(rods, std::move(systems));
  }

  void step() {
    const auto one = [&](int i) { runs_[static_cast<std::size_t>(i)]->simulation().step(); };
    if (joined_) return joined_->step(one);
    for (int i = 0; i < static_cast<int>(runs_.size()); ++i) one(i);
  }

 private:
  const std::vector<std::unique_ptr<MemberRun>>& runs_;
  std::optional<cosserat::JoinedSystems> joined_;
};

}  // namespace

JointPath::Point arm_at(const SceneMember& member, double t) {
  const JointPath& path = *member.path;
  const SceneState& state = *member.state;
  if (member.is_run) return path.at(t);
  // A row at t holds what was at t - delay.
  JointPath::Point point = path.at(t + state.robot_delay);
  if (const double dt = member.run_step; dt > 0.0) {
    // Bullet moves a joint by its velocity at the step's end. A run begins at rest.
    const bool begins = t < 0.5 * dt;
    if (begins) point.qd.setZero();
    if (!begins) point.qd = (point.q - path.at(t + state.robot_delay - dt).q) / dt;
  }
  point.q += state.joint_offset;
  return point;
}

std::vector<SceneMotion> run_scene_trial(const Experiment& experiment, const Trial& trial,
                                         std::span<const std::unique_ptr<PlantMaker>> makers,
                                         const simulation::ShapeFields& fields,
                                         const SceneNumerics& numerics, double until,
                                         std::span<const SceneMember> members,
                                         const std::atomic<bool>& stop) {
  const int steps = std::max(1, static_cast<int>(std::ceil(until / numerics.dt - 1.0e-9)));
  std::vector<std::unique_ptr<MemberRun>> runs;
  bool touching = false;
  for (const SceneMember& member : members) {
    runs.push_back(
        std::make_unique<MemberRun>(experiment, trial, makers, fields, numerics, member, steps));
    touching = touching || member.state->coupling.plant_contact;
  }
  Stepper stepper(runs, solver_settings(experiment, numerics), experiment, touching);
  for (int k = 1; k <= steps; ++k) {
    const double t = k * numerics.dt;
    for (const auto& run : runs) run->push(t);
    stepper.step();
    bool any = false;
    for (const auto& run : runs) {
      if (stop) run->fail();
      if (run->healthy()) run->note(k, t);
      any = any || run->healthy();
    }
    if (!any) break;
  }
  std::vector<SceneMotion> motions;
  motions.reserve(runs.size());
  for (const auto& run : runs) motions.push_back(run->take());
  return motions;
}

}  // namespace pedicel::discrepancy
