#include "app/session/live/snapshot_maker.h"

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/simulation/channels.h"
#include "plugins/simulation/plants/surface_strain.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::app {

std::string to_string(RunMode mode) {
  static const char* const names[] = {"empty",   "building",  "paused",
                                      "playing", "replaying", "unstable"};
  return names[static_cast<int>(mode)];
}

void SnapshotMaker::forget(bool new_stage) {
  if (new_stage) ++stage_;
  models_.clear();
  bodies_.clear();
  colliders_.reset();
  events_.reset();
}

std::shared_ptr<Snapshot> SnapshotMaker::make(const LiveRun& run) {
  const simulation::Simulation& simulation = run.simulation();
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->number = ++number_;
  snapshot->stage = stage_;
  snapshot->assets = simulation.assets();
  snapshot->step = run.steps();
  snapshot->time = simulation.world().time();
  snapshot->report = simulation.world().report();
  add_events(simulation);
  snapshot->events = events_;
  add_plants(simulation, *snapshot);
  add_strain(simulation, *snapshot);
  add_bodies(simulation, *snapshot);
  for (const simulation::SceneTies::One& tie : simulation.ties().all())
    if (const auto course = simulation.ties().course(tie))
      snapshot->ties.push_back({tie.number, *course});
  add_contacts(simulation, *snapshot);
  add_robot(simulation, *snapshot);
  snapshot->pull = run.pull().snapshot();
  return snapshot;
}

std::shared_ptr<Snapshot> SnapshotMaker::again(const Snapshot& before) {
  auto snapshot = std::make_shared<Snapshot>(before);
  snapshot->number = ++number_;
  return snapshot;
}

void SnapshotMaker::add_events(const simulation::Simulation& simulation) {
  const std::size_t count =
      simulation.plant_step().detached().size() + simulation.cutting().events().size();
  if (events_ && events_->size() == count) return;
  events_ = std::make_shared<const std::vector<world::Event>>(simulation::events_of(simulation));
  models_.clear();  // what has lost a fruit is lighter
}

void SnapshotMaker::add_plants(const simulation::Simulation& simulation, Snapshot& snapshot) {
  const cosserat::RodSystem& rods = simulation.rods();
  for (int p = static_cast<int>(models_.size()); p < rods.size(); ++p)
    models_.push_back(std::make_shared<const cosserat::RodModel>(rods.model(p)));
  for (int p = 0; p < rods.size(); ++p) {
    PlantSnapshot plant{models_[p], rods.state(p), {}};
    for (int f = 0; f < static_cast<int>(models_[p]->fruits.size()); ++f)
      plant.margin_used.push_back(cosserat::margin_used(*models_[p], plant.state, f));
    snapshot.plants.push_back(std::move(plant));
  }
}

void SnapshotMaker::add_strain(const simulation::Simulation& simulation, Snapshot& snapshot) const {
  const cosserat::RodSystem& rods = simulation.rods();
  for (int p = 0; p < rods.size(); ++p)
    for (int e = 0; e < rods.model(p).size(); ++e) {
      if (!rods.state(p).alive[e]) continue;
      const double strain = simulation::surface_strain(rods.model(p), rods.state(p), e);
      if (!(strain > snapshot.largest_strain)) continue;
      snapshot.largest_strain = strain;
      snapshot.largest_strain_organ = rods.model(p).organs[rods.model(p).elements[e].organ];
    }
}

void SnapshotMaker::add_bodies(const simulation::Simulation& simulation, Snapshot& snapshot) {
  const world::SimWorld& world = simulation.world();
  for (int b = static_cast<int>(bodies_.size()); b < world.body_count(); ++b) {
    auto info = std::make_shared<BodyInfo>();
    info->description = world.body(b);
    for (const simulation::Detached& fruit : simulation.plant_step().detached()) {
      if (fruit.body != b) continue;
      info->plant = fruit.plant;
      info->fruit = fruit.event.fruit;
      info->stub_length = fruit.event.stub_length;
      info->stub_radius = fruit.event.stub_radius;
    }
    bodies_.push_back(std::move(info));
  }
  for (int b = 0; b < world.body_count(); ++b)
    snapshot.bodies.push_back({bodies_[b], world.body_pose(b)});
}

void SnapshotMaker::add_contacts(const simulation::Simulation& simulation, Snapshot& snapshot) {
  const cosserat::RodSystem& rods = simulation.rods();
  for (int p = 0; p < rods.size(); ++p)
    for (const cosserat::ContactForce& one : rods.contact_forces(p)) {
      ContactSnapshot contact;
      contact.place_W = one.place_W;
      contact.force_W = one.normal * one.point.normal_W + one.tangential_W;
      contact.plant = p;
      contact.element = rods.model(p).shapes[one.point.shape].element;
      if (!cosserat::is_self_contact(one.point.collider)) contact.collider = one.point.collider;
      snapshot.contacts.push_back(contact);
    }
  if (!colliders_) {
    std::vector<std::string> names;
    for (int c = 0; c < simulation.colliders().size(); ++c)
      names.push_back(simulation.colliders().collider(c).name);
    colliders_ = std::make_shared<const std::vector<std::string>>(std::move(names));
  }
  snapshot.colliders = colliders_;
}

void SnapshotMaker::add_robot(const simulation::Simulation& simulation, Snapshot& snapshot) const {
  const simulation::RobotControl* robot = simulation.robot();
  if (!robot) return;
  snapshot.robot = {true,
                    robot->tool_link(),
                    robot->link_poses(),
                    robot->robot().positions(),
                    robot->goal(),
                    robot->robot().motor_torques(),
                    robot->tool_pose(),
                    robot->follows_program(),
                    robot->follows_program() && robot->program().loops()};
  if (!robot->follows_program()) return;
  snapshot.robot.program_time = robot->program().time(snapshot.time);
  snapshot.robot.program_duration = robot->program().duration(snapshot.time);
}

}  // namespace pedicel::app
