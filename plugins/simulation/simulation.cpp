#include "plugins/simulation/simulation.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/world/scene_writer.h"
#include "plugins/simulation/giving_robot.h"
#include "plugins/simulation/held_organs.h"
#include "plugins/simulation/instrument.h"
#include "plugins/simulation/place.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/scene_contacts.h"

namespace pedicel::simulation {

namespace {

// World and plants take the same step: Bullet makes exactly one, and the rods one of the same
// length, so that neither has to be interpolated to the other's time.
world::WorldSettings world_settings(const world::Scene& scene) {
  world::WorldSettings settings;
  settings.dt = scene.dt;
  settings.gravity = scene.gravity;
  return settings;
}

/// Robot with its program, bodies, ground, loads, ties, cuts and wind: what stands in a world
/// beside its plants.
std::string things_of(world::Scene scene) {
  // Plants are left out, because these may change in constants. All else is built once from the
  // first assets, and a change of it needs a new run.
  world::Scene things;
  // Compared as text, so that no field can be forgotten in a comparison.
  things.robot = std::move(scene.robot);
  // Recorded poses are played by a command; a run does not know them.
  if (things.robot) things.robot->recorded.clear();
  things.bodies = std::move(scene.bodies);
  things.ground = scene.ground;
  things.loads = std::move(scene.loads);
  things.ties = std::move(scene.ties);
  things.cuts = std::move(scene.cuts);
  things.wind = scene.wind;
  things.effects = std::move(scene.effects);
  return world::scene_text_without_plants(things, {});
}

}  // namespace

Simulation::Simulation(const world::Scene& scene, const SimulationOptions& options)
    : Simulation(std::make_shared<const SceneAssets>(scene, options)) {}

namespace {

/// A camera that follows nothing would stand at the world's origin. An optional plant that is not
/// there is no fault.
void check_cameras(const Simulation& simulation, Diagnostics& diagnostics) {
  for (const world::SceneCamera& camera : simulation.scene().cameras) {
    const world::Anchor& anchor = camera.follow;
    if (anchor.kind == world::Anchor::Kind::none || place_of(simulation, anchor)) continue;
    const std::string plant = anchor.name.substr(0, anchor.name.find('/'));
    std::string known;
    for (int p = 0; p < simulation.rods().size(); ++p) {
      const cosserat::RodModel& model = simulation.rods().model(p);
      if (model.name != plant && !model.name.starts_with(plant + "_")) continue;
      std::vector<std::string> names = {model.name};
      if (anchor.kind == world::Anchor::Kind::fruit) names.clear();
      for (int f = 0; f < static_cast<int>(model.fruits.size()) && names.size() < 20; ++f)
        names.push_back(fruit_name(model, f));
      if (names.empty()) names.push_back("fruits of another plant (it has none)");
      for (const std::string& name : names)
        if (known.size() < 200) known += (known.empty() ? "" : ", ") + name;
    }
    if (known.empty()) continue;
    diagnostics.error(anchor.where, "camera " + in_quotes(camera.name) + " follows " +
                                        in_quotes(anchor.name) +
                                        ", which is not there, expected one of: " + known);
  }
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const SceneAssets> assets)
    : assets_(std::move(assets)),
      scene_(assets_->scene),
      world_(world_settings(scene_)),
      notes_(assets_->notes) {
  Diagnostics diagnostics;
  // Plants first: loads, waypoints and contacts name their fruits.
  // The order of what follows is that of who needs whom. Members are destroyed in the reverse order
  // of their declaration, so what refers to others is declared after them.
  rods_ = std::make_unique<cosserat::RodSystem>(assets_->rods, scene_.threads);
  add_plants(diagnostics);
  // Before the robot, whose waypoints may be at a body.
  add_bodies();
  loads_ = std::make_unique<SceneLoads>(scene_.loads, *rods_, diagnostics);
  ties_ = std::make_unique<SceneTies>(scene_.ties, *rods_, diagnostics);
  add_robot(diagnostics);
  check_cameras(*this, diagnostics);
  cutting_ = std::make_unique<Cutting>(scene_.cuts, *rods_, world_, diagnostics);
  if (robot_) cutting_->set_tool([this] { return robot_->tool_pose(); });
  // Contacts are set up where all things stand, so nothing may be missing by now.
  // All faults are collected first and said together: a user who mends one should not meet the next
  // one only then.
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  contacts_ = std::make_unique<SceneContacts>(*assets_, world_, *rods_, robot_.get(), giving_.get(),
                                              held_.get(), diagnostics);
  // Set now, as it takes contacts, which take everything above.
  cutting_->set_released([this](int plant, int body) { contacts_->add_fallen(plant, body); });
  measurements_ = std::make_unique<Measurements>(*rods_, plant_step(), colliders());
  gentleness_ = std::make_unique<Gentleness>(*rods_, plant_step());
  instruments_ = std::make_unique<Instruments>(*this, diagnostics);
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  // Participants of one phase act in the order in which they join.
  // Loads and cuts first: what a scene does at a time holds for the whole of that step.
  world_.add(*loads_);
  world_.add(*cutting_);
  if (scene_.wind) {
    wind_ = std::make_unique<WindField>(*scene_.wind, scene_.seed, *rods_);
    world_.add(*wind_);
  }
  // Colliders, plants and reaction, in their own order. The robot's reader has joined before, so
  // that links are where Bullet left them.
  contacts_->join();
  // Observers last: they see the step when all have moved. Who plays what was recorded looks at the
  // plants himself.
  if (!assets_->readings) {
    world_.add(*measurements_);
    world_.add(*gentleness_);
  }
  world_.add(*instruments_);
  // Errors have thrown above, so warnings are all that is left.
  for (const Diagnostic& warning : diagnostics.all()) notes_.push_back(to_string(warning));
}

Simulation::~Simulation() = default;

const PlantStep& Simulation::plant_step() const {
  return contacts_->plant_step();
}

const coupling::ColliderSet& Simulation::colliders() const {
  return contacts_->colliders();
}

const std::vector<std::unique_ptr<Instrument>>& Simulation::instruments() const {
  return instruments_->all();
}

void Simulation::add_plants(Diagnostics& diagnostics) {
  // Refused and not ignored: a run without the wind that its scene asks for would look like one
  // with it.
  if (scene_.wind && assets_->rods.solver != cosserat::SolverKind::direct)
    diagnostics.error({scene_.file.string(), 0, 0},
                      "wind with the position-based solver: expected the direct solver, which "
                      "alone has air");
  if (assets_->coupling.plant_contact && assets_->rods.solver != cosserat::SolverKind::direct)
    diagnostics.error({scene_.file.string(), 0, 0},
                      "coupling.plant_contact is 1 with the position-based solver: expected the "
                      "direct solver, which alone lets plants touch each other");
  for (const cosserat::RodModel& model : assets_->models) {
    const int plant = rods_->add_plant(model);
    if (!assets_->states.empty())
      rods_->set_state(plant, assets_->states[static_cast<std::size_t>(plant)]);
  }
}

void Simulation::add_bodies() {
  if (scene_.ground) world_.set_ground(*scene_.ground);
  for (const world::BodyDescription& body : scene_.bodies) world_.add_body(body);
}

void Simulation::add_robot(Diagnostics& diagnostics) {
  if (!assets_->robot) return;
  const auto find_place = [this](const world::Anchor& anchor) { return place_of(*this, anchor); };
  LedRobot led;
  if (assets_->effects) {
    const discrepancy::SceneState& state = assets_->effects->state;
    led.believed = assets_->believed ? &*assets_->believed : nullptr;
    led.log_delay = state.robot_delay;
    led.lag = state.tracking_lag;
  }
  led.readings = assets_->readings;
  // Where nothing loose could feel it, Bullet need not know of a robot that is placed anyway.
  led.moves = !led.readings || assets_->loose_fruits ||
              std::ranges::any_of(scene_.bodies, [](const auto& body) { return body.mass > 0.0; });
  robot_ = make_robot_control(*scene_.robot, *assets_->robot, world_, find_place, led, diagnostics);
  if (!robot_) return;
  const bool gives = assets_->effects && assets_->effects->state.joint_stiffness > 0.0;
  if (gives) {
    giving_ = std::make_unique<GivingRobot>(*robot_, assets_->effects->state, scene_.dt);
    world_.add(giving_->before());
  }
  world_.add(*robot_);
  // The control acts before Bullet, the reader after it. They are two participants, since one has
  // one phase.
  world_.add(robot_->reader());
  if (gives) world_.add(giving_->after());
  if (assets_->grasps.empty()) return;
  held_ = std::make_unique<HeldOrgans>(assets_->grasps, *rods_, robot_->robot());
  world_.add(held_->before());
  world_.add(held_->carry());
}

const std::vector<PlantInfo>& Simulation::plants() const {
  return assets_->plants;
}

bool Simulation::can_change_to(const SceneAssets& assets) const {
  const coupling::CouplingSettings &now = assets_->coupling, &then = assets.coupling;
  // These decide what is set up once, so they cannot change under way.
  const bool same_contacts = now.margin == then.margin && now.two_way == then.two_way &&
                             now.self_contact == then.self_contact &&
                             now.plant_contact == then.plant_contact &&
                             now.blade_contact == then.blade_contact;
  // The file counts, too: relative paths and names are found from its folder.
  const bool same_world =
      scene_.dt == assets.scene.dt && scene_.gravity == assets.scene.gravity &&
      scene_.threads == assets.scene.threads && scene_.file == assets.scene.file &&
      things_of(scene_) == things_of(assets.scene) && assets_->rods.solver == assets.rods.solver;
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
  // After the plants: contacts are looked for with the shapes that these have now.
  contacts_->change_settings(assets->coupling);
  // References into the first assets stay: scene, meshes, fields.
  // The scene that was read first goes on to be the one that runs; only constants come from the
  // other.
  // Only the first time: later ones are referred to by nobody.
  if (!first_assets_) first_assets_ = assets_;
  assets_ = std::move(assets);
}

std::uint64_t Simulation::state_hash() const {
  StateHash hash;
  // The order is part of the hash: in another one it is another number.
  // Bullet's bodies, then plants, then joints. Everything that the next step starts from is in it.
  world_.add_to(hash);
  rods_->add_to(hash);
  if (robot_) robot_->add_to(hash);
  return hash.value();
}

}  // namespace pedicel::simulation
