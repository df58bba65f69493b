#include "plugins/simulation/plants/cutting.h"

#include <limits>

#include "engine/core/check.h"
#include "plugins/cosserat/solver/detachment.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::simulation {

namespace {

// A capsule for each stem that came off, a ball for each fruit, about the common centre of mass.
world::BodyDescription body_of(const cosserat::RodModel& model, const cosserat::RodState& state,
                               const cosserat::CutOff& off) {
  world::BodyDescription body;
  body.mass = off.mass;
  body.pose.position = off.centre_W;
  body.velocity = off.velocity_W;
  body.angular_velocity = off.angular_velocity_W;
  body.friction = 0.7;
  body.look = "wood";
  for (const int e : off.elements) {
    const cosserat::Element& element = model.elements[e];
    world::BodyPart part;
    part.kind = world::BodyPart::Kind::capsule;
    part.radius = 0.5 * (element.radius_near + element.radius_far);
    part.length = element.length;
    part.pose = {cosserat::point_on(model, state, e, 0.5 * element.length) - off.centre_W,
                 state.orientation[e]};
    body.parts.push_back(part);
  }
  for (const int f : off.fruits) {
    const cosserat::Fruit& fruit = model.fruits[f];
    world::BodyPart part;
    part.kind = world::BodyPart::Kind::sphere;
    part.radius = fruit.radius;
    part.pose.position = cosserat::point_on(model, state, fruit.element, fruit.back) - off.centre_W;
    body.parts.push_back(part);
  }
  return body;
}

}  // namespace

Cutting::Cutting(const std::vector<world::SceneCut>& cuts, cosserat::RodSystem& rods,
                 world::SimWorld& world, Diagnostics& diagnostics)
    : rods_(rods), world_(world) {
  for (const world::SceneCut& cut : cuts) try {
      planned_.push_back({&cut, find_organ_place(rods_, cut.organ, cut.at)});
    } catch (const UsageError& error) {
      diagnostics.error(cut.where, error.what());
    }
}

void Cutting::cut(const std::string& organ, double at) {
  const PlaceOnPlant place = find_organ_place(rods_, organ, at);
  if (!rods_.state(place.plant).alive[place.element])
    throw UsageError("cut: " + in_quotes(organ) + " has come off there already");
  cut_at(place, organ);
}

bool Cutting::can_cut(const std::string& organ, double at) const try {
  const PlaceOnPlant place = find_organ_place(rods_, organ, at);
  return rods_.state(place.plant).alive[place.element] != 0;
} catch (const UsageError&) {
  return false;
}

std::optional<Cutting::Carried> Cutting::carried(int plant, int fruit) const {
  const auto found = carried_.find({plant, fruit});
  return found == carried_.end() ? std::nullopt : std::optional(found->second);
}

int Cutting::body_with(int plant, int element) const {
  const auto found = bodies_.find({plant, element});
  return found == bodies_.end() ? -1 : found->second;
}

void Cutting::act(world::SimWorld&, world::WorldReport&) {
  for (Planned& one : planned_) {
    if (one.done || !is_due(one)) continue;
    one.done = true;
    if (rods_.state(one.place.plant).alive[one.place.element]) cut_at(one.place, one.cut->organ);
  }
}

bool Cutting::is_due(const Planned& one) const {
  if (one.cut->time) return world_.time() >= *one.cut->time;
  if (!tool_) return false;
  const Vec3 place = cosserat::point_on(rods_.model(one.place.plant), rods_.state(one.place.plant),
                                        one.place.element, one.place.back);
  return (tool_().position - place).norm() <= one.cut->reach;
}

void Cutting::cut_at(const PlaceOnPlant& place, const std::string& organ) {
  const cosserat::RodModel& model = rods_.model(place.plant);
  const cosserat::JointLoad load =
      cosserat::joint_load(model, rods_.state(place.plant), place.element);
  cosserat::RodState& state = rods_.edit_state(place.plant);
  const cosserat::CutOff off = cosserat::cut(model, state, place.element);
  world::BodyDescription body = body_of(model, state, off);
  body.name = organ + "_cut";
  for (int n = 2; world_.body_index(body.name) >= 0; ++n)
    body.name = organ + "_cut_" + std::to_string(n);
  const int added = world_.add_body(body);
  for (const int e : off.elements) bodies_[{place.plant, e}] = added;
  for (const int f : off.fruits) {
    const cosserat::Fruit& fruit = model.fruits[f];
    carried_[{place.plant, f}] = {
        added, cosserat::point_on(model, state, fruit.element, fruit.back) - off.centre_W,
        cosserat::start_of(model, state, fruit.element) - off.centre_W};
  }
  if (released_) released_(place.plant, added);
  world::Event event;
  event.time = world_.time();
  event.organ = organ;
  event.cause = "cut";
  event.force = load.force.norm();
  event.moment = load.moment.head<2>().norm();
  event.torsion = std::abs(load.moment.z());
  event.tool.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (tool_) event.tool = tool_();
  events_.push_back(event);
}

}  // namespace pedicel::simulation
