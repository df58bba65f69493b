#include "pedicel/app/run/simulation.h"

#include <algorithm>

#include "pedicel/app/run/colliders.h"
#include "pedicel/app/run/scene_assets.h"
#include "pedicel/app/run/start_overlaps.h"
#include "pedicel/core/check.h"
#include "pedicel/world/scene_writer.h"

namespace pedicel::app {

namespace {

world::WorldSettings world_settings(const world::Scene& scene) {
  world::WorldSettings settings;
  settings.dt = scene.dt;
  settings.gravity = scene.gravity;
  return settings;
}

/// Robot with its program, bodies, ground and loads: what stands in a world beside its plants.
std::string things_of(world::Scene scene) {
  world::Scene things;
  things.robot = std::move(scene.robot);
  if (things.robot) things.robot->recorded.clear();
  things.bodies = std::move(scene.bodies);
  things.ground = scene.ground;
  things.loads = std::move(scene.loads);
  return world::scene_text_without_plants(things, {});
}

}  // namespace

/// The scene's loads act before the plants move.
class Simulation::LoadStep : public world::Participant {
 public:
  explicit LoadStep(Simulation& simulation) : simulation_(simulation) {}
  world::Phase phase() const override { return world::Phase::commands; }
  void act(world::SimWorld& world, world::StepReport&) override {
    simulation_.apply_loads(world.time());
  }

 private:
  Simulation& simulation_;
};

Simulation::Simulation(const world::Scene& scene, const SimulationOptions& options)
    : Simulation(std::make_shared<const SceneAssets>(scene, options)) {}

Simulation::Simulation(std::shared_ptr<const SceneAssets> assets)
    : assets_(std::move(assets)),
      scene_(assets_->scene),
      world_(world_settings(scene_)),
      notes_(assets_->notes) {
  Diagnostics diagnostics;
  rods_ = std::make_unique<cosserat::RodSystem>(rod_settings(), scene_.threads);
  add_plants();
  add_bodies();
  add_loads(diagnostics);
  add_robot(diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  add_contacts(diagnostics);
  for (const Diagnostic& warning : diagnostics.all()) notes_.push_back(to_string(warning));
}

Simulation::~Simulation() = default;

void Simulation::add_plants() {
  for (const cosserat::RodModel& model : assets_->models) rods_->add_plant(model);
}

std::string Simulation::worst_residual() const {
  const PlantInfo* worst = nullptr;
  for (const PlantInfo& plant : plants())
    if (plant.residual && (!worst || plant.residual->largest > worst->residual->largest))
      worst = &plant;
  return worst ? worst->residual_text : "";
}

void Simulation::add_bodies() {
  if (scene_.ground) world_.set_ground(*scene_.ground);
  for (const world::BodyDescription& body : scene_.bodies) world_.add_body(body);
}

void Simulation::add_robot(Diagnostics& diagnostics) {
  if (!assets_->robot) return;
  const auto find_place = [this](const world::Anchor& anchor) { return find(anchor); };
  robot_ = make_robot_control(*scene_.robot, *assets_->robot, world_, find_place, diagnostics);
  if (!robot_) return;
  world_.add(*robot_);
  world_.add(robot_->reader());
}

void Simulation::add_contacts(Diagnostics& diagnostics) {
  if (scene_.ground) add_ground_collider(colliders_, *scene_.ground);
  for (int b = 0; b < world_.body_count(); ++b)
    add_body_colliders(colliders_, world_.body(b), b, world_.body_pose(b));
  if (robot_)
    add_robot_colliders(colliders_, robot_->name(), robot_->description(), assets_->robot_fields,
                        robot_->link_poses());
  const bool grips = robot_ && robot_->gripper() >= 0 && scene_.robot->control != "torque" &&
                     rod_settings().solver == cosserat::SolverKind::direct;
  if (grips) grip_ = std::make_unique<Grip>(*robot_, colliders_);
  for (int p = 0; p < rods_->size(); ++p) add_contact_sources(p, diagnostics);
  plant_step_ = std::make_unique<PlantStep>(
      *rods_, colliders_, [this](const coupling::Collider& c) { return link_pose(c); });
  if (robot_) plant_step_->set_tool([this] { return robot_->tool_pose(); });
  if (coupling_settings().two_way) {
    reaction_ = std::make_unique<Reaction>(world_, robot_.get(), colliders_);
    if (grip_) grip_->pass_on(plant_step_->contacts());
    plant_step_->set_reaction(
        [this](const coupling::ContactReport& contacts) { reaction_->act(contacts); });
  }
  load_step_ = std::make_unique<LoadStep>(*this);
  measurements_ = std::make_unique<Measurements>(*rods_, *plant_step_, colliders_);
  world_.add(*load_step_);
  if (grip_) world_.add(grip_->before());
  world_.add(*plant_step_);
  if (grip_) world_.add(grip_->after());
  world_.add(*measurements_);
}

// Where the scene says what a collider belongs to.
SourcePosition Simulation::place_of(const coupling::Collider& collider) const {
  if (collider.body == robot_body) return scene_.robot->where;
  return {scene_.file.string(), 0, 0};
}

void Simulation::add_contact_sources(int p, Diagnostics& diagnostics) {
  auto source = std::make_unique<coupling::ColliderSource>(colliders_, coupling_settings());
  const std::vector<coupling::Overlap> overlaps =
      source->ignore_touching(rods_->model(p), rods_->state(p));
  for (const StartOverlap& overlap : start_overlaps(rods_->model(p), colliders_, overlaps))
    diagnostics.warning(place_of(colliders_.collider(overlap.collider)), overlap.text);
  collider_sources_.push_back(source.get());
  if (grip_) grip_->add(*source);
  rods_->add_contact_source(p, std::move(source));
  if (!coupling_settings().self_contact) return;
  auto own = std::make_unique<cosserat::SelfContact>(
      rods_->model(p), coupling::self_contact_settings(coupling_settings()));
  self_contacts_.push_back(own.get());
  rods_->add_contact_source(p, std::move(own));
}

const std::vector<PlantInfo>& Simulation::plants() const {
  return assets_->plants;
}
const cosserat::RodSettings& Simulation::rod_settings() const {
  return assets_->rods;
}
const coupling::CouplingSettings& Simulation::coupling_settings() const {
  return assets_->coupling;
}

bool Simulation::can_change_to(const SceneAssets& assets) const {
  const coupling::CouplingSettings &now = coupling_settings(), &then = assets.coupling;
  const bool same_contacts = now.margin == then.margin && now.two_way == then.two_way &&
                             now.self_contact == then.self_contact;
  const bool same_world =
      scene_.dt == assets.scene.dt && scene_.gravity == assets.scene.gravity &&
      scene_.threads == assets.scene.threads && scene_.file == assets.scene.file &&
      things_of(scene_) == things_of(assets.scene) && rod_settings().solver == assets.rods.solver;
  if (!same_contacts || !same_world || rods_->size() != static_cast<int>(assets.models.size()))
    return false;
  for (int p = 0; p < rods_->size(); ++p)
    if (!cosserat::differs_in_constants_only(rods_->model(p), assets.models[p])) return false;
  return true;
}

void Simulation::change_to(std::shared_ptr<const SceneAssets> assets) {
  if (!can_change_to(*assets))
    throw UsageError("Simulation::change_to: another scene, must differ in constants only");
  for (int p = 0; p < rods_->size(); ++p) rods_->change_constants(p, assets->models[p]);
  rods_->change_settings(assets->rods);
  for (coupling::ColliderSource* source : collider_sources_)
    source->change_settings(assets->coupling);
  for (cosserat::SelfContact* own : self_contacts_)
    own->change_settings(coupling::self_contact_settings(assets->coupling));
  if (!first_assets_) first_assets_ = assets_;
  assets_ = std::move(assets);
}

Pose Simulation::link_pose(const coupling::Collider& collider) const {
  if (collider.body == robot_body) return robot_->link_pose(collider.link);
  if (collider.body == ground_body) return Pose{};
  return world_.body_pose(collider.body);
}

void Simulation::add_loads(Diagnostics& diagnostics) {
  for (const world::SceneLoad& load : scene_.loads) {
    bool found = false;
    for (int p = 0; p < rods_->size(); ++p) {
      const cosserat::RodModel& model = rods_->model(p);
      for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
        if (fruit_name(model, f) != load.target) continue;
        found = true;
        loads_.push_back({&load, p, f, rods_->loads(p).size()});
        rods_->loads(p).push_back({model.fruits[f].element, model.fruits[f].back, {}, {}});
        rods_->loads(p).back().force_W.setZero();
        rods_->loads(p).back().moment_W.setZero();
      }
    }
    if (!found)
      diagnostics.error(load.where,
                        "load on \"" + load.target + "\", expected PLANT/FRUIT of this scene");
  }
}

void Simulation::apply_loads(double time) {
  for (const FruitLoad& one : loads_) {
    const world::SceneLoad& load = *one.load;
    double share = time >= load.from && time < load.to ? 1.0 : 0.0;
    if (load.ramp) share *= (time - load.from) / (load.to - load.from);
    if (rods_->state(one.plant).fruit_gone[one.fruit]) share = 0.0;
    rods_->loads(one.plant)[one.slot].force_W = share * load.force;
  }
}

std::optional<Vec3> Simulation::find(const world::Anchor& anchor) const {
  if (anchor.kind == world::Anchor::Kind::tool && robot_) return robot_->tool_pose().position;
  if (anchor.kind == world::Anchor::Kind::body) {
    const int body = world_.body_index(anchor.name);
    if (body >= 0) return world_.body_pose(body).position;
    return std::nullopt;
  }
  for (int p = 0; p < rods_->size(); ++p) {
    const cosserat::RodModel& model = rods_->model(p);
    if (anchor.kind == world::Anchor::Kind::plant && model.name == anchor.name)
      return model.root.position;
    if (anchor.kind != world::Anchor::Kind::fruit) continue;
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      if (fruit_name(model, f) != anchor.name) continue;
      const int body = world_.body_index(anchor.name);  // it has come off
      if (body >= 0) return world_.body_pose(body).position;
      return cosserat::point_on(model, rods_->state(p), model.fruits[f].element,
                                model.fruits[f].back);
    }
  }
  return std::nullopt;
}

std::uint64_t Simulation::state_hash() const {
  StateHash hash;
  world_.add_to(hash);
  rods_->add_to(hash);
  if (robot_) robot_->add_to(hash);
  return hash.value();
}

}  // namespace pedicel::app
