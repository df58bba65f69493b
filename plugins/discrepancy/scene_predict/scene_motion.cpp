#include "plugins/discrepancy/scene_predict/scene_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "plugins/cosserat/model/rotation.h"
#include "plugins/cosserat/solver/equilibrium.h"
#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/coupling/contact_report.h"
#include "plugins/discrepancy/scene/giving_joints.h"
#include "plugins/discrepancy/scene/giving_source.h"
#include "plugins/discrepancy/scene/state_changes.h"
#include "plugins/discrepancy/simulate/variant_plant.h"
#include "plugins/simulation/colliders.h"
#include "plugins/simulation/plants/start_overlaps.h"

namespace pedicel::discrepancy {

namespace {

/// N/m, of what a link holds; and the nearest to a segment's middle that a hold gives way in
/// bending, as a share of its length.
constexpr double hold_stiffness = 1.0e6, least_bent = 5.0e-3;
constexpr int curve_places = 200;

// As for trials of plants (trial_run.cpp), but for contact, whose iterations end where they find
// no better place.
cosserat::RodSettings solver_settings(double tolerance) {
  cosserat::RodSettings settings;
  settings.newton_iterations = 12;
  settings.tolerance = tolerance;
  return settings;
}

/// One variant of a scene while it runs: its plants, its arm and what they feel of each other.
class SceneRun {
 public:
  SceneRun(const SceneExperiment& experiment, const SceneTrial& trial,
           std::span<const std::unique_ptr<PlantMaker>> makers, const LinkFields& fields,
           const SceneNumerics& numerics, const SceneMember& member, int steps)
      : experiment_(experiment),
        trial_(trial),
        makers_(makers),
        member_(member),
        margin_(numerics.margin),
        dt_(numerics.dt),
        report_(colliders_),
        joints_(*member.arm, *member.state, numerics.dt) {
    settings_ = member.state->coupling;
    arm_.gives = joints_.give();
    settings_.margin = arm_.gives ? std::max(numerics.margin, reach_back) : numerics.margin;
    arm_.arm = member.arm;
    member.arm->model().link_poses(arm_at(member, 0.0).q, arm_.links);
    add_colliders(fields);
    make_plants();
    const long markers = static_cast<long>(experiment.markers.size());
    motion_.position.setZero(steps + 1, 3 * markers);
    motion_.velocity.setZero(steps + 1, 3 * markers);
    motion_.turn.setZero(steps + 1, 4 * markers);
    motion_.contact.setZero(steps + 1, 6 * static_cast<long>(experiment.wrenches.size()));
    motion_.effort.setZero(steps + 1, member.arm->model().dofs());
    if (arm_.gives) motion_.given.setZero(steps + 1, 3 * motion_.effort.cols());
  }

  /// Adds its plants at rest.
  void begin(cosserat::RodSystem& rods) {
    first_ = rods.size();
    for (std::size_t p = 0; p < models_.size(); ++p) {
      cosserat::RodState state = first_state(p);
      const cosserat::RodModel unladen = makers_[p]->unladen(models_[p], masses_of(p));
      if (cosserat::is_hung(models_[p]) &&
          !hang(models_[p], unladen, state, experiment_.scene.gravity))
        motion_.healthy = false;
      if (!find_equilibrium(models_[p], state, experiment_.scene.gravity, {}))
        motion_.healthy = false;
      auto source = std::make_unique<GivingSource>(colliders_, settings_, margin_,
                                                   simulation::robot_body, arm_);
      source->ignore_touching(models_[p], state);
      lean_on_arm(p, state, *source);
      const int plant = rods.add_plant(models_[p]);
      rods.set_state(plant, state);
      sources_.push_back(source.get());
      rods.add_contact_source(plant, std::move(source));
    }
    record(rods, 0, 0.0);
  }

  void move(double t) {
    place_links(t);
    poses_.resize(static_cast<std::size_t>(colliders_.size()));
    for (int c = 0; c < colliders_.size(); ++c) {
      const coupling::Collider& collider = colliders_.collider(c);
      Pose& pose = poses_[static_cast<std::size_t>(c)];
      if (collider.body == simulation::robot_body)
        pose = arm_.links[static_cast<std::size_t>(collider.link)];
      else if (collider.body >= 0)  // bodies rest where the scene puts them
        pose = experiment_.scene.bodies[static_cast<std::size_t>(collider.body)].pose;
      else
        pose = Pose{};
    }
    colliders_.update(poses_);
  }

  /// Takes hold of organs and lets them go, as was recorded up to `t`.
  void grasp(cosserat::RodSystem& rods, double t) {
    for (; next_event_ < trial_.events.size() && trial_.events[next_event_].time <= t;
         ++next_event_) {
      const SceneEvent& event = trial_.events[next_event_];
      if (event.event == "grasped") take_hold(rods, event);
      if (event.event == "released")
        std::erase_if(held_, [&](const Held& held) { return held.what == event.what; });
      changed_ = changed_ || event.event == "grasped" || event.event == "released";
    }
  }

  /// Moves what is held to where its links are now.
  void carry(cosserat::RodSystem& rods) {
    if (held_.empty() && !changed_) return;
    changed_ = !held_.empty();
    for (std::size_t p = 0; p < models_.size(); ++p) {
      std::vector<cosserat::Support>& supports = rods.supports(first_ + static_cast<int>(p));
      supports.resize(models_[p].supports.size());
      for (const Held& held : held_)
        if (held.plant == static_cast<int>(p) &&
            rods.state(first_ + held.plant).alive[held.place.element])
          supports.push_back(support_of(held));
    }
  }

  /// What acts from outside at a time.
  void push(cosserat::RodSystem& rods, double t) const {
    for (std::size_t p = 0; p < models_.size() && !member_.forces.empty(); ++p)
      rods.loads(first_ + static_cast<int>(p)).clear();
    for (std::size_t f = 0; f < member_.forces.size(); ++f) {
      const SceneForce& force = member_.forces[f];
      const double share =
          force.rise > 0.0 ? std::clamp((t - force.from) / force.rise, 0.0, 1.0) : 1.0;
      if (t < force.from || t > force.until) continue;
      const plant::PlacedPoint& at = force_places_[f];
      const int plant = first_ + force.plant;
      if (rods.state(plant).alive[at.element])
        rods.loads(plant).push_back({at.element, at.back, share * force.force, Vec3::Zero()});
    }
  }

  void record(const cosserat::RodSystem& rods, int row, double t) {
    motion_.time.push_back(t);
    for (std::size_t m = 0; m < experiment_.markers.size(); ++m) {
      const SceneMarker& marker = experiment_.markers[m];
      if (marker.plant < 0) continue;
      const int p = first_ + marker.plant;
      const cosserat::RodModel& model = rods.model(p);
      const cosserat::RodState& state = rods.state(p);
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
    if (row > 0) record_contact(rods, row);
  }

  bool judge(const cosserat::RodSystem& rods) {
    for (std::size_t p = 0; p < models_.size(); ++p)
      if (rods.report(first_ + static_cast<int>(p)).errors & cosserat::not_finite)
        motion_.healthy = false;
    return motion_.healthy;
  }

  void take_events(const cosserat::RodSystem& rods, double t) {
    for (std::size_t p = 0; p < models_.size(); ++p)
      for (const cosserat::DetachEvent& event : rods.detached(first_ + static_cast<int>(p)))
        motion_.events.push_back({t, "detached", models_[p].fruits[event.fruit].name, ""});
  }

  void fail() { motion_.healthy = false; }
  bool healthy() const { return motion_.healthy; }
  SceneMotion take() { return std::move(motion_); }

 private:
  /// An organ that a link holds rigidly.
  struct Held {
    std::string what;
    int plant = 0, link = 0;
    plant::PlacedPoint place;  // of the spring that holds it
    Vec3 position_L;           // m, of that place
    Vec3 centre_L;             // m, of the organ
    Quat rotation;             // E to L
    Vec3 turning;              // N m/rad
    double mass = 0.0;         // kg, of a fruit: once it is off the plant, the link carries it
    std::array<Vec3, 2> before{Vec3::Zero(), Vec3::Zero()};  // m, W, at the last two steps
  };

  // By the link that is named, else by the tool. Of a curve the place nearest to the link's origin.
  void take_hold(const cosserat::RodSystem& rods, const SceneEvent& event) {
    Held held;
    held.what = event.what;
    const int named = experiment_.robot.link(event.by);
    held.link = named >= 0 ? named : member_.arm->tool();
    const Pose& link = arm_.links[static_cast<std::size_t>(held.link)];
    bool found = false;
    for (std::size_t p = 0; p < models_.size() && !found; ++p) {
      const cosserat::RodModel& model = models_[p];
      const cosserat::RodState& state = rods.state(first_ + static_cast<int>(p));
      held.plant = static_cast<int>(p);
      for (const cosserat::Fruit& fruit : model.fruits)
        if (fruit.name == event.what) {
          held.place = {fruit.element, fruit.back};
          held.mass = 4.0 / 3.0 * std::numbers::pi * std::pow(fruit.radius, 3) * fruit.density;
          found = true;
        }
      const int curve = experiment_.plants[p].file.curve_index(event.what);
      double nearest = std::numeric_limits<double>::infinity();
      for (int i = 0; i <= curve_places && !found && curve >= 0; ++i) {
        const plant::PlacedPoint place =
            makers_[p]->nominal().locate(curve, static_cast<double>(i) / curve_places);
        const double distance =
            (cosserat::point_on(model, state, place.element, place.back) - link.position).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        held.place = place;
      }
      found = found || curve >= 0;
      if (!found) continue;
      held.centre_L = link.inverse() * place_of(state, held.place);
      give_way(model.elements[held.place.element], held);
      held.position_L = link.inverse() * place_of(state, held.place);
      held.rotation = link.rotation.conjugate() * state.orientation[held.place.element];
    }
    held.before.fill(link * held.centre_L);
    if (found) held_.push_back(std::move(held));
  }

  // A segment's frame is that of its middle, and the stalk bends from there to where it is held:
  // over half of the segment, where a fruit at its end is. Without that a short stalk is stiffer by
  // a half segment. A spring in the middle of that stretch stands for it, as the midpoint rule has
  // it: at its end a stalk of six segments between two clamps would be softer by 5 %.
  static void give_way(const cosserat::Element& element, Held& held) {
    const double middle = 0.5 * element.length;
    const double bent = std::max(std::abs(middle - held.place.back), least_bent * element.length);
    held.turning = Vec3(element.section.bend1, element.section.bend2, element.section.twist) / bent;
    held.place.back = 0.5 * (middle + held.place.back);
  }

  // m, W, of a place as a support has it: on the segment's axis from its far node. Its own strain
  // would be a force of newtons in a spring this stiff.
  static Vec3 place_of(const cosserat::RodState& state, const plant::PlacedPoint& place) {
    const auto e = static_cast<std::size_t>(place.element);
    return state.position[e] - place.back * (state.orientation[e] * Vec3::UnitZ());
  }

  cosserat::Support support_of(const Held& held) const {
    const Pose& link = arm_.links[static_cast<std::size_t>(held.link)];
    cosserat::Support support;
    support.element = held.place.element;
    support.back = held.place.back;
    support.position = link * held.position_L;
    support.rotation = (link.rotation * held.rotation).normalized();
    support.position_stiffness = hold_stiffness;
    support.rotation_stiffness = held.turning;
    return support;
  }

  // What the held organs exert on their links.
  void record_held(const cosserat::RodSystem& rods, int row) {
    for (Held& held : held_) {
      const cosserat::RodState& state = rods.state(first_ + held.plant);
      const Vec3 here = arm_.links[static_cast<std::size_t>(held.link)] * held.centre_L;
      const Vec3 acceleration = (here - 2.0 * held.before[1] + held.before[0]) / (dt_ * dt_);
      held.before = {held.before[1], here};
      if (!state.alive[held.place.element]) {
        coupling::ContactSum sum;
        sum.force_W = held.mass * (experiment_.scene.gravity - acceleration);
        sum.place_W = here;
        add_contact(held.link, sum, row);
        continue;
      }
      const cosserat::Support support = support_of(held);
      const Vec3 place = place_of(state, held.place);
      coupling::ContactSum sum;
      sum.force_W = hold_stiffness * (place - support.position);
      sum.place_W = place;
      const Quat& own = state.orientation[held.place.element];
      const Vec3 turned = cosserat::log_map(support.rotation.conjugate() * own);
      sum.moment_W = own * held.turning.cwiseProduct(turned);
      add_contact(held.link, sum, row);
    }
  }

  void place_links(double t) {
    Eigen::VectorXd q = arm_at(member_, t).q;
    joints_.begin_step(q);
    arm_.compliance = joints_.compliance();
    member_.arm->model().link_poses(q + joints_.deflection(), arm_.links);
  }

  void add_colliders(const LinkFields& fields) {
    simulation::add_robot_colliders(colliders_, "robot", member_.arm->description(), fields,
                                    arm_.links, member_.state->friction_of_link);
    const world::Scene& scene = experiment_.scene;
    if (scene.ground) simulation::add_ground_collider(colliders_, *scene.ground);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      simulation::add_body_colliders(colliders_, scene.bodies[b], static_cast<int>(b),
                                     scene.bodies[b].pose);
  }

  Trial masses_of(std::size_t plant) const {
    Trial trial;
    trial.clock = trial_.clock;
    for (const SceneTrial::Mass& mass : trial_.masses)
      if (mass.plant == static_cast<int>(plant)) trial.masses.push_back(mass.mass);
    return trial;
  }

  void make_plants() {
    for (std::size_t p = 0; p < makers_.size(); ++p) {
      std::vector<plant::Effect> own;
      for (const plant::Effect& effect : member_.effects) {
        const auto named = effect.words.find("plant");
        if (named == effect.words.end() || named->second == experiment_.plants[p].name)
          own.push_back(effect);
      }
      cosserat::RodModel model = makers_[p]->make(masses_of(p), own).model;
      const SceneState::Plant& state = member_.state->plants[p];
      change_plant(model, state);
      move_supports(model, state);
      models_.push_back(std::move(model));
    }
    for (const SceneForce& force : member_.forces)
      force_places_.push_back(makers_[static_cast<std::size_t>(force.plant)]->locate(force.place));
    places_.resize(experiment_.markers.size());
    for (std::size_t m = 0; m < places_.size(); ++m) {
      const SceneMarker& marker = experiment_.markers[m];
      if (marker.plant < 0) continue;
      if (marker.fruit < 0) {
        places_[m] = makers_[static_cast<std::size_t>(marker.plant)]->locate(marker.place);
      } else {
        const cosserat::Fruit& fruit = models_[static_cast<std::size_t>(marker.plant)]
                                           .fruits[static_cast<std::size_t>(marker.fruit)];
        places_[m] = {fruit.element, fruit.back};
      }
    }
  }

  static void move_supports(cosserat::RodModel& model, const SceneState::Plant& state) {
    const Pose by = moved_plant(model.root.position, state);
    for (cosserat::Support& support : model.supports) {
      support.position = by * support.position;
      support.rotation = by.rotation * support.rotation;
    }
  }

  // A stem that stands where the arm begins leans on it: what was measured overlapped nowhere.
  void lean_on_arm(std::size_t p, cosserat::RodState& state, GivingSource& source) {
    if (!source.overlaps_arm(models_[p], state)) return;
    // How far a joint gives way is known in a step alone, and the first one moves it there.
    const bool gives = std::exchange(arm_.gives, false);
    const bool rests = simulation::lean(models_[p], state, experiment_.scene.gravity, source);
    arm_.gives = gives;
    leans_ = leans_ || rests;  // of several plants one is enough
    if (rests) return;
    // Where it finds no rest the two do not touch, as in a run.
    source.inner().ignore_touching(models_[p], state);
  }

  cosserat::RodState first_state(std::size_t p) const {
    cosserat::RodState state = cosserat::drawn_state(models_[p]);
    const Pose by = moved_plant(models_[p].root.position, member_.state->plants[p]);
    state.root = state.previous_root = by * models_[p].root;
    for (int e = 0; e < state.size(); ++e) {
      state.position[e] = by * state.position[e];
      state.orientation[e] = (by.rotation * state.orientation[e]).normalized();
    }
    return state;
  }

  void record_contact(const cosserat::RodSystem& rods, int row) {
    report_.begin();
    for (std::size_t p = 0; p < models_.size(); ++p) {
      const int plant = first_ + static_cast<int>(p);
      report_.add(static_cast<int>(p), rods.model(plant), rods.contact_forces(plant));
      if (arm_.gives) sources_[p]->remember(rods.contact_forces(plant));
    }
    report_.end();
    for (int c = 0; c < colliders_.size(); ++c) {
      const coupling::ContactSum& sum = report_.colliders()[static_cast<std::size_t>(c)];
      if (sum.contacts == 0 || colliders_.collider(c).body != simulation::robot_body) continue;
      add_contact(colliders_.collider(c).link, sum, row);
    }
    record_held(rods, row);
    // Before the first step no force is known.
    if (row == 1 && leans_) {
      motion_.contact.row(0) = motion_.contact.row(1);
      motion_.effort.row(0) = motion_.effort.row(1);
    }
    if (!arm_.gives) return;
    joints_.end_step(motion_.effort.row(row).transpose());
    motion_.given.row(row) = joints_.row();
  }

  void add_contact(int link, const coupling::ContactSum& sum, int row) {
    for (std::size_t w = 0; w < experiment_.wrenches.size(); ++w) {
      const int own = experiment_.wrenches[w].link;
      const std::vector<int>& beyond = member_.arm->beyond(own);
      if (std::ranges::find(beyond, link) == beyond.end()) continue;
      const Pose& pose = arm_.links[static_cast<std::size_t>(own)];
      const Quat back = pose.rotation.conjugate();
      const Vec3 moment = sum.moment_W + (sum.place_W - pose.position).cross(sum.force_W);
      const auto at = static_cast<long>(w);
      motion_.contact.row(row).segment<3>(6 * at) += (back * sum.force_W).transpose();
      motion_.contact.row(row).segment<3>(6 * at + 3) += (back * moment).transpose();
    }
    const Pose& pose = arm_.links[static_cast<std::size_t>(link)];
    robot::Jacobian jacobian;
    member_.arm->model().jacobian(arm_.links, link, pose.inverse() * sum.place_W, jacobian);
    Eigen::Matrix<double, 6, 1> push;
    push << sum.force_W, sum.moment_W;
    motion_.effort.row(row) += (jacobian.transpose() * push).transpose();
  }

  const SceneExperiment& experiment_;
  const SceneTrial& trial_;
  std::span<const std::unique_ptr<PlantMaker>> makers_;
  const SceneMember& member_;
  double margin_;  // m
  double dt_;      // s
  coupling::CouplingSettings settings_;
  coupling::ColliderSet colliders_;
  coupling::ContactReport report_;
  std::vector<cosserat::RodModel> models_;
  std::vector<GivingSource*> sources_;      // one a plant; the system owns them
  std::vector<plant::PlacedPoint> places_;  // of the markers
  std::vector<plant::PlacedPoint> force_places_;
  GivingJoints joints_;
  GivingArm arm_;
  std::vector<Held> held_;
  std::size_t next_event_ = 0;
  bool changed_ = false;  // supports are those of the model no longer
  bool leans_ = false;    // a plant on the arm, from the start
  std::vector<Pose> poses_;
  int first_ = 0;  // of its plants
  SceneMotion motion_;
};

}  // namespace

JointPath::Point arm_at(const SceneMember& member, double t) {
  const JointPath& path = *member.path;
  const SceneState& state = *member.state;
  if (member.is_run) return path.at(t);
  // A row at t holds what was at t - delay.
  JointPath::Point point = path.at(t + state.robot_delay);
  point.q += state.joint_offset;
  return point;
}

std::vector<SceneMotion> run_scene_trial(const SceneExperiment& experiment, const SceneTrial& trial,
                                         std::span<const std::unique_ptr<PlantMaker>> makers,
                                         const LinkFields& fields, const SceneNumerics& numerics,
                                         double until, std::span<const SceneMember> members,
                                         const std::atomic<bool>& stop) {
  const int steps = std::max(1, static_cast<int>(std::ceil(until / numerics.dt - 1.0e-9)));
  cosserat::RodSystem rods(solver_settings(numerics.tolerance));
  std::vector<std::unique_ptr<SceneRun>> variants;
  for (const SceneMember& member : members) {
    variants.push_back(
        std::make_unique<SceneRun>(experiment, trial, makers, fields, numerics, member, steps));
    variants.back()->begin(rods);
  }
  for (int k = 1; k <= steps; ++k) {
    const double t = k * numerics.dt;
    for (const auto& variant : variants) {
      // Within reach of the pose in which it was grasped.
      variant->grasp(rods, t - numerics.dt);
      variant->move(t);
      variant->carry(rods);
      variant->push(rods, t);
    }
    rods.step(numerics.dt, experiment.scene.gravity);
    bool any = false;
    for (const auto& variant : variants) {
      if (!variant->healthy()) continue;
      variant->take_events(rods, t);
      if (stop || !variant->judge(rods)) {
        variant->fail();
        continue;
      }
      variant->record(rods, k, t);
      any = true;
    }
    if (!any) break;
  }
  std::vector<SceneMotion> motions;
  for (const auto& variant : variants) motions.push_back(variant->take());
  return motions;
}

}  // namespace pedicel::discrepancy
