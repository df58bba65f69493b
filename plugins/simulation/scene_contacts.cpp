#include "plugins/simulation/scene_contacts.h"

#include <algorithm>

#include "plugins/cosserat/contact/plant_blades.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/simulation/body_contacts.h"
#include "plugins/simulation/colliders.h"
#include "plugins/simulation/plants/start_overlaps.h"
#include "plugins/simulation/scene_assets.h"

namespace pedicel::simulation {

SceneContacts::SceneContacts(const SceneAssets& assets, world::SimWorld& world,
                             cosserat::RodSystem& rods, RobotControl* robot, GivingRobot* giving,
                             HeldOrgans* held, Diagnostics& diagnostics)
    : scene_(assets.scene),
      world_(world),
      rods_(rods),
      robot_(robot),
      giving_(giving),
      held_(held) {
  // The grip marks the colliders that it presses, before the sources look at what touches.
  add_colliders(assets);
  add_grip(assets);
  for (int p = 0; p < rods_.size(); ++p) add_sources(assets, p, diagnostics);
  touch_each_other_ = assets.coupling.plant_contact;
  if (touch_each_other_) rods_.let_plants_touch(coupling::self_contact_settings(assets.coupling));
  plant_step_ = std::make_unique<PlantStep>(
      rods_, colliders_, [this](const coupling::Collider& c) { return link_pose(c); });
  if (robot_) plant_step_->set_tool([this] { return robot_->tool_pose(); });
  if (touch_each_other_)
    plant_step_->set_released(
        [this](const Detached& fruit) { add_fallen(fruit.plant, fruit.body); });
  // One way: plants feel the robot, and the robot moves as if they were not there. What has come
  // off them always feels them, or it would fall through their leaves.
  const bool all = assets.coupling.two_way;
  if (all || touch_each_other_)
    // An arm whose joints give way feels plants through these, and not through its motors.
    reaction_ = std::make_unique<Reaction>(world_, all && !giving_ ? robot_ : nullptr, colliders_,
                                           all ? 0 : world_.body_count());
  if (all && grip_) grip_->pass_on(plant_step_->contacts());
  if (reaction_ || giving_ || assets.readings)
    plant_step_->set_reaction(
        [this](const coupling::ContactReport& contacts) { act_back(contacts); });
}

void SceneContacts::act_back(const coupling::ContactReport& contacts) {
  if (reaction_) reaction_->act(contacts);
  if (giving_ || (robot_ && robot_->led_by_readings())) sum_up(contacts);
  if (!giving_) return;
  for (int p = 0; p < rods_.size(); ++p)
    with_giving_[static_cast<std::size_t>(p)]->remember(rods_.contact_forces(p));
  giving_->act(effort_);
}

void SceneContacts::sum_up(const coupling::ContactReport& contacts) {
  link_forces_.clear();
  for (int c = 0; c < colliders_.size(); ++c) {
    const coupling::ContactSum& sum = contacts.colliders()[static_cast<std::size_t>(c)];
    const coupling::Collider& collider = colliders_.collider(c);
    if (collider.body == robot_body && sum.contacts > 0)
      link_forces_.push_back({collider.link, sum.force_W, sum.place_W, sum.moment_W});
  }
  if (held_) held_->add_forces(world_, link_forces_);
  // Of a robot that moves by itself Bullet knows these; one that is led only hears of them here.
  if (robot_->led_by_readings())
    each_body_contact(world_, robot_->robot(),
                      [this](int link, const Vec3& force_W, const Vec3& place_W) {
                        link_forces_.push_back({link, force_W, place_W, Vec3::Zero()});
                      });
  effort_ = robot_->robot().effort_of(link_forces_);
}

void SceneContacts::add_colliders(const SceneAssets& assets) {
  if (scene_.ground) add_ground_collider(colliders_, *scene_.ground);
  // Bodies that come later are fruits that came off (add_fallen()).
  for (int b = 0; b < world_.body_count(); ++b)
    add_body_colliders(colliders_, world_.body(b), b, world_.body_pose(b));
  if (robot_)
    add_robot_colliders(
        colliders_, robot_->name(), robot_->description(), assets.robot_fields,
        robot_->link_poses(),
        assets.effects ? assets.effects->state.friction_of_link : std::map<int, double>{});
}

// A gripper stands where its motor balances what it holds. Only the direct solver tells how far a
// plant gives way to it, and under torque control there is no motor that presses.
void SceneContacts::add_grip(const SceneAssets& assets) {
  const bool grips = robot_ && robot_->gripper() >= 0 && scene_.robot->control != "torque" &&
                     assets.rods.solver == cosserat::SolverKind::direct;
  if (grips) grip_ = std::make_unique<GripperStep>(*robot_, colliders_);
}

void SceneContacts::add_sources(const SceneAssets& assets, int p, Diagnostics& diagnostics) {
  const std::vector<bool> leaning = lean_on_robot(assets, p);
  coupling::ColliderSource& source = add_source(assets, p);
  // A plant drawn through a link would be shot out in the first step.
  const std::vector<coupling::Overlap> overlaps =
      source.ignore_touching(rods_.model(p), rods_.state(p), [&](int shape, int collider) {
        return leaning.empty() || !leaning[static_cast<std::size_t>(shape)] ||
               colliders_.collider(collider).body != robot_body;
      });
  for (const StartOverlap& overlap : start_overlaps(rods_.model(p), colliders_, overlaps))
    diagnostics.warning(place_of(colliders_.collider(overlap.collider)), overlap.text);
  sources_.push_back(&source);
  if (grip_) grip_->add(source);
  if (assets.coupling.blade_contact) add_blades(assets, p);
  // Plants that touch each other touch themselves there, too.
  if (!assets.coupling.self_contact || assets.coupling.plant_contact) return;
  auto own = std::make_unique<cosserat::SelfContact>(
      rods_.model(p), coupling::self_contact_settings(assets.coupling));
  self_contacts_.push_back(own.get());
  rods_.add_contact_source(p, std::move(own));
}

std::vector<bool> SceneContacts::lean_on_robot(const SceneAssets& assets, int p) {
  if (!robot_ || assets.rods.solver != cosserat::SolverKind::direct) return {};
  cosserat::RodState state = rods_.state(p);
  coupling::ColliderSource source(colliders_, assets.coupling);
  const auto is_robot = [this](int c) { return colliders_.collider(c).body == robot_body; };
  const auto is_finger = [this](int c) {
    return robot_->gripper() >= 0 &&
           robot_->robot().model().moves(robot_->gripper(), colliders_.collider(c).link);
  };
  const std::vector<bool> leaning =
      leaning_stems(rods_.model(p), source.overlaps(rods_.model(p), state, assets.coupling.margin),
                    is_robot, is_finger);
  if (leaning.empty()) return {};
  source.ignore_touching(rods_.model(p), state, [&](int shape, int collider) {
    return !leaning[static_cast<std::size_t>(shape)] || !is_robot(collider);
  });
  // Where it finds no rest the two do not touch.
  if (!lean(rods_.model(p), state, scene_.gravity, source)) return {};
  rods_.set_state(p, state);
  return leaning;
}

void SceneContacts::add_blades(const SceneAssets& assets, int p) {
  const std::vector<Blade>& blades = assets.plants[static_cast<std::size_t>(p)].blades;
  if (blades.empty()) return;
  auto source = std::make_unique<coupling::BladeSource>(colliders_, assets.coupling, blades);
  source->ignore_touching(rods_.model(p), rods_.state(p));
  blades_.push_back(source.get());
  rods_.add_contact_source(p, std::move(source));
  if (!assets.coupling.plant_contact) return;
  std::vector<cosserat::BladeTriangle> triangles;
  for (const Blade& blade : blades) {
    cosserat::BladeTriangle& corners = triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {blade[i].element, blade[i].back};
  }
  rods_.add_contact_source(p, std::make_unique<cosserat::PlantBlades>(
                                  std::move(triangles), coupling::blade_half_thickness));
}

coupling::ColliderSource& SceneContacts::add_source(const SceneAssets& assets, int p) {
  if (!giving_) {
    auto source = std::make_unique<coupling::ColliderSource>(colliders_, assets.coupling);
    coupling::ColliderSource& added = *source;
    rods_.add_contact_source(p, std::move(source));
    return added;
  }
  coupling::CouplingSettings wide = assets.coupling;
  wide.margin = std::max(wide.margin, discrepancy::reach_back);
  auto source = std::make_unique<discrepancy::GivingSource>(
      colliders_, wide, assets.coupling.margin, robot_body, giving_->arm());
  with_giving_.push_back(source.get());
  rods_.add_contact_source(p, std::move(source));
  return with_giving_.back()->inner();
}

void SceneContacts::join() {
  if (grip_) world_.add(grip_->before());
  world_.add(*plant_step_);
  if (grip_) world_.add(grip_->after());
}

void SceneContacts::change_settings(const coupling::CouplingSettings& settings) {
  coupling::CouplingSettings wide = settings;
  if (giving_) wide.margin = std::max(wide.margin, discrepancy::reach_back);
  for (coupling::ColliderSource* source : sources_) source->change_settings(wide);
  for (coupling::BladeSource* blades : blades_) blades->change_settings(settings);
  for (cosserat::SelfContact* own : self_contacts_)
    own->change_settings(coupling::self_contact_settings(settings));
  if (touch_each_other_) rods_.let_plants_touch(coupling::self_contact_settings(settings));
}

// Where it hung it still overlaps what carried it, which lets it go.
void SceneContacts::add_fallen(int plant, int body) {
  if (!touch_each_other_) return;
  const int first = colliders_.size();
  add_body_colliders(colliders_, world_.body(body), body, world_.body_pose(body));
  for (int c = first; c < colliders_.size(); ++c)
    sources_[plant]->ignore_touching(rods_.model(plant), rods_.state(plant), c);
}

// Where the scene says what a collider belongs to.
SourcePosition SceneContacts::place_of(const coupling::Collider& collider) const {
  if (collider.body == robot_body) return scene_.robot->where;
  return {scene_.file.string(), 0, 0};
}

Pose SceneContacts::link_pose(const coupling::Collider& collider) const {
  if (collider.body == robot_body) return robot_->link_pose(collider.link);
  // The ground never moves, so its field is given in the world.
  if (collider.body == ground_body) return Pose{};
  return world_.body_pose(collider.body);
}

}  // namespace pedicel::simulation
