#include "plugins/simulation/channels.h"

#include <algorithm>
#include <limits>

#include "plugins/simulation/instrument.h"
#include "plugins/simulation/place.h"
#include "plugins/simulation/plants/organ_contacts.h"
#include "plugins/simulation/scene_assets.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

namespace {

using Channels = std::vector<Channel>;

constexpr std::size_t most_organs = 60;

void add_robot(Channels& all, const Simulation& simulation) {
  const RobotControl* robot = simulation.robot();
  if (!robot) return;
  const robot::KinematicModel& model = robot->robot().model();
  for (int i = 0; i < model.dofs(); ++i) {
    const std::string& joint = model.joint_names()[i];
    const bool slides = robot->description().joints[robot->description().joint(joint)].type ==
                        robot::JointType::prismatic;
    all.push_back(
        {"joint_" + joint + (slides ? "_m" : "_rad"), [robot, i] { return robot->reading(i); }});
    all.push_back({"torque_" + joint + (slides ? "_N" : "_Nm"),
                   [robot, i] { return robot->robot().motor_torques()[i]; }});
  }
  const char* names[] = {"tool_x_m", "tool_y_m", "tool_z_m"};
  for (int i = 0; i < 3; ++i)
    all.push_back({names[i], [robot, i] { return robot->tool_pose().position[i]; }});
}

// One column a link or body, over all its colliders.
void add_colliders(Channels& all, const Simulation& simulation) {
  std::vector<std::string> done;
  const coupling::ColliderSet& set = simulation.colliders();
  for (int c = 0; c < set.size(); ++c) {
    const std::string name = set.collider(c).name;
    if (std::find(done.begin(), done.end(), name) != done.end()) continue;
    done.push_back(name);
    const auto sum = [&simulation, &set, name](double coupling::ContactSum::*value) {
      double total = 0.0;
      for (int i = 0; i < set.size(); ++i)
        if (set.collider(i).name == name)
          total += simulation.plant_step().contacts().colliders()[i].*value;
      return total;
    };
    all.push_back(
        {"contact_" + name + "_normal_N", [sum] { return sum(&coupling::ContactSum::normal); }});
    all.push_back({"contact_" + name + "_tangential_N",
                   [sum] { return sum(&coupling::ContactSum::tangential); }});
  }
}

void add_organs(Channels& all, const Simulation& simulation) {
  std::size_t organs = 0;
  for (int p = 0; p < simulation.rods().size(); ++p)
    organs += simulation.rods().model(p).organs.size();
  for (int p = 0; p < simulation.rods().size() && organs <= most_organs; ++p) {
    const cosserat::RodModel& model = simulation.rods().model(p);
    for (std::size_t o = 0; o < model.organs.size(); ++o) {
      all.push_back({"contact_" + model.organs[o] + "_normal_N", [&simulation, p, o] {
                       return simulation.plant_step().contacts().organs(p)[o].normal;
                     }});
      all.push_back({"contact_" + model.organs[o] + "_tangential_N", [&simulation, p, o] {
                       return simulation.plant_step().contacts().organs(p)[o].tangential;
                     }});
    }
  }
}

void add_fruit(Channels& all, const Simulation& simulation, int p, int f) {
  const cosserat::RodModel& model = simulation.rods().model(p);
  const std::string name = fruit_name(model, f);
  const auto strain = [&simulation, p, f](bool bend) {
    const cosserat::RodState& state = simulation.rods().state(p);
    if (state.fruit_gone[f]) return std::numeric_limits<double>::quiet_NaN();
    const cosserat::Strain s = cosserat::strain_of(simulation.rods().model(p), state,
                                                   simulation.rods().model(p).fruits[f].element);
    return bend ? s.bend.norm() : s.stretch.norm();
  };
  all.push_back({name + "_stretch_1", [strain] { return strain(false); }});
  all.push_back({name + "_bend_rad", [strain] { return strain(true); }});
  all.push_back({name + "_margin_used_1", [&simulation, p, f] {
                   return cosserat::margin_used(simulation.rods().model(p),
                                                simulation.rods().state(p), f);
                 }});
  const auto load = [&simulation, p, f](Vec3 cosserat::JointLoad::*part) {
    const cosserat::RodState& state = simulation.rods().state(p);
    if (state.fruit_gone[f]) return std::numeric_limits<double>::quiet_NaN();
    const cosserat::RodModel& own = simulation.rods().model(p);
    return (cosserat::joint_load(own, state, own.fruits[f].element).*part).norm();
  };
  all.push_back({name + "_stalk_N", [load] { return load(&cosserat::JointLoad::force); }});
  all.push_back({name + "_stalk_Nm", [load] { return load(&cosserat::JointLoad::moment); }});
  all.push_back({name + "_contact_N", [&simulation, p, f] {
                   return simulation.plant_step().contacts().fruits(p)[f].normal;
                 }});
  world::Anchor anchor;
  anchor.kind = world::Anchor::Kind::fruit;
  anchor.name = name;
  all.push_back(
      {name + "_z_m", [&simulation, anchor] { return place_of(simulation, anchor)->z(); }});
}

void add_plants(Channels& all, const Simulation& simulation) {
  const auto energy = [&simulation](double cosserat::Energy::*part) {
    double sum = 0.0;
    for (int p = 0; p < simulation.rods().size(); ++p)
      sum += cosserat::energy_of(simulation.rods().model(p), simulation.rods().state(p),
                                 simulation.scene().gravity).*
             part;
    return sum;
  };
  all.push_back({"energy_kinetic_J", [energy] { return energy(&cosserat::Energy::kinetic); }});
  all.push_back({"energy_elastic_J", [energy] { return energy(&cosserat::Energy::elastic); }});
  all.push_back({"energy_gravity_J", [energy] { return energy(&cosserat::Energy::gravity); }});
  all.push_back({"stretch_max_1", [&simulation] {
                   double largest = 0.0;
                   for (int p = 0; p < simulation.rods().size(); ++p)
                     for (int e = 0; e < simulation.rods().model(p).size(); ++e)
                       if (simulation.rods().state(p).alive[e])
                         largest =
                             std::max(largest, cosserat::strain_of(simulation.rods().model(p),
                                                                   simulation.rods().state(p), e)
                                                   .stretch.norm());
                   return largest;
                 }});
  for (const SceneTies::One& tie : simulation.ties().all())
    all.push_back(
        {tie.name + "_N", [&simulation, &tie] { return simulation.ties().tension(tie); }});
  if (simulation.assets()->coupling.plant_contact)
    all.push_back({"contact_between_plants_N", [&simulation] {
                     double sum = 0.0;
                     for (const OrganContact& one : organ_contacts(simulation.rods()))
                       sum += one.normal;
                     return sum;
                   }});
  all.push_back({"contacts_1", [&simulation] {
                   return static_cast<double>(simulation.world().report().contacts);
                 }});
  all.push_back({"detached_1", [&simulation] {
                   return static_cast<double>(simulation.plant_step().detached().size());
                 }});
}

void add_instruments(Channels& all, const Simulation& simulation) {
  for (const auto& one : simulation.instruments())
    for (std::size_t i = 0; i < 3 * one->kind().vectors.size(); ++i) {
      const world::InstrumentVector& vector = one->kind().vectors[i / 3];
      std::string unit = vector.unit;
      std::erase(unit, ' ');
      all.push_back(
          {one->kind().name + "_" + one->scene().name + "_" + vector.columns[i % 3] + "_" + unit,
           [&one, i] { return one->reading()[static_cast<long>(i)]; }});
    }
}

}  // namespace

std::vector<Channel> channels_of(const Simulation& simulation) {
  Channels all;
  add_robot(all, simulation);
  add_plants(all, simulation);
  for (int p = 0; p < simulation.rods().size(); ++p)
    for (int f = 0; f < static_cast<int>(simulation.rods().model(p).fruits.size()); ++f)
      add_fruit(all, simulation, p, f);
  add_colliders(all, simulation);
  add_organs(all, simulation);
  add_instruments(all, simulation);
  return all;
}

void add_channels(world::Recorder& recorder, const Simulation& simulation) {
  for (Channel& channel : channels_of(simulation))
    recorder.add_channel(std::move(channel.name), std::move(channel.read));
}

world::Event to_event(const Detached& detached) {
  const cosserat::DetachEvent& e = detached.event;
  return {e.time,  detached.fruit, e.cause,   e.stretch, e.bend,
          e.force, e.moment,       e.torsion, e.angle,   detached.tool};
}

std::vector<world::Event> events_of(const Simulation& simulation) {
  std::vector<world::Event> events;
  for (const Detached& one : simulation.plant_step().detached()) events.push_back(to_event(one));
  const auto& cuts = simulation.cutting().events();
  events.insert(events.end(), cuts.begin(), cuts.end());
  std::ranges::stable_sort(events, {}, &world::Event::time);
  return events;
}

}  // namespace pedicel::simulation
