#include "plugins/simulation/held_organs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "plugins/cosserat/model/rotation.h"

namespace pedicel::simulation {

namespace {

constexpr double hold_stiffness = 1.0e6;  // N/m
/// The nearest to a segment's middle that a hold gives way in bending, as a share of its length.
constexpr double least_bent = 5.0e-3;
constexpr int curve_places = 200;  // looked at for the nearest

// m, W, of a place as a support has it: on the segment's axis from its far node. Its own strain
// would be a force of newtons in a spring this stiff.
Vec3 position_of(const cosserat::RodState& state, const PlaceOnPlant& place) {
  const auto e = static_cast<std::size_t>(place.element);
  return state.position[e] - place.back * (state.orientation[e] * Vec3::UnitZ());
}

// A segment's frame is that of its middle, and the stalk bends from there to where it is held: over
// half of the segment, where a fruit at its end is. Without that a short stalk is stiffer by a half
// segment. A spring in the middle of that stretch stands for it, as the midpoint rule has it: at
// its end a stalk of six segments between two clamps would be softer by 5 %. Returns the spring's
// stiffness, N m/rad.
Vec3 give_way(const cosserat::Element& element, double& back) {
  const double middle = 0.5 * element.length;
  const double bent = std::max(std::abs(middle - back), least_bent * element.length);
  back = 0.5 * (middle + back);
  return Vec3(element.section.bend1, element.section.bend2, element.section.twist) / bent;
}

}  // namespace

HeldOrgans::HeldOrgans(std::vector<Grasp> grasps, cosserat::RodSystem& rods,
                       const robot::Robot& robot)
    : grasps_(std::move(grasps)),
      rods_(rods),
      robot_(robot),
      before_(world::Phase::commands, *this, &HeldOrgans::take_and_release),
      carry_(world::Phase::plants, *this, &HeldOrgans::carry_along) {
  std::ranges::stable_sort(grasps_, {}, &Grasp::time);
  for (int p = 0; p < rods_.size(); ++p) own_supports_.push_back(rods_.supports(p).size());
}

void HeldOrgans::take_and_release(double time) {
  for (; next_ < grasps_.size() && grasps_[next_].time <= time; ++next_) {
    const Grasp& grasp = grasps_[next_];
    if (grasp.takes)
      take_hold(grasp);
    else
      std::erase_if(held_, [&](const Held& held) { return held.what == grasp.what; });
    changed_ = true;
  }
}

// Of a curve the place nearest to the link's origin.
bool HeldOrgans::find(const Grasp& grasp, Held& held) const {
  for (int p = 0; p < rods_.size(); ++p) {
    const cosserat::RodModel& model = rods_.model(p);
    for (const cosserat::Fruit& fruit : model.fruits) {
      if (fruit.name != grasp.what) continue;
      held.place = {p, fruit.element, fruit.back};
      held.mass = 4.0 / 3.0 * std::numbers::pi * std::pow(fruit.radius, 3) * fruit.density;
      return true;
    }
    const std::string organ = model.name + "/" + grasp.what;
    if (std::ranges::find(model.organs, organ) == model.organs.end()) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= curve_places; ++i) {
      const PlaceOnPlant place =
          find_organ_place(rods_, organ, static_cast<double>(i) / curve_places);
      const double distance =
          (cosserat::point_on(model, rods_.state(p), place.element, place.back) -
           robot_.link_pose_W(grasp.link).position)
              .norm();
      if (distance >= nearest) continue;
      nearest = distance;
      held.place = place;
    }
    return true;
  }
  return false;
}

void HeldOrgans::take_hold(const Grasp& grasp) {
  Held held;
  held.what = grasp.what;
  held.link = grasp.link;
  if (!find(grasp, held)) return;
  const Pose& link = robot_.link_pose_W(held.link);
  const cosserat::RodState& state = rods_.state(held.place.plant);
  held.centre_L = link.inverse() * position_of(state, held.place);
  held.turning =
      give_way(rods_.model(held.place.plant).elements[held.place.element], held.place.back);
  held.position_L = link.inverse() * position_of(state, held.place);
  held.rotation = link.rotation.conjugate() * state.orientation[held.place.element];
  held.before.fill(link * held.centre_L);
  held_.push_back(std::move(held));
}

void HeldOrgans::carry_along(double) {
  if (!changed_) return;
  changed_ = !held_.empty();
  for (int p = 0; p < rods_.size(); ++p) {
    std::vector<cosserat::Support>& supports = rods_.supports(p);
    supports.resize(own_supports_[static_cast<std::size_t>(p)]);
    for (const Held& held : held_)
      if (held.place.plant == p && is_on_plant(held)) supports.push_back(support_of(held));
  }
}

cosserat::Support HeldOrgans::support_of(const Held& held) const {
  const Pose& link = robot_.link_pose_W(held.link);
  cosserat::Support support;
  support.element = held.place.element;
  support.back = held.place.back;
  support.position = link * held.position_L;
  support.rotation = (link.rotation * held.rotation).normalized();
  support.position_stiffness = hold_stiffness;
  support.rotation_stiffness = held.turning;
  return support;
}

void HeldOrgans::add_forces(const world::SimWorld& world,
                            std::vector<robot::LinkReaction>& forces) {
  const double dt = world.dt();
  for (Held& held : held_) {
    const Vec3 here = robot_.link_pose_W(held.link) * held.centre_L;
    const Vec3 acceleration = (here - 2.0 * held.before[1] + held.before[0]) / (dt * dt);
    held.before = {held.before[1], here};
    robot::LinkReaction& force = forces.emplace_back();
    force.link = held.link;
    if (!is_on_plant(held)) {
      force.force_W = held.mass * (world.settings().gravity - acceleration);
      force.point_W = here;
      continue;
    }
    const cosserat::Support support = support_of(held);
    const cosserat::RodState& state = rods_.state(held.place.plant);
    force.point_W = position_of(state, held.place);
    force.force_W = hold_stiffness * (force.point_W - support.position);
    const Quat& own = state.orientation[held.place.element];
    force.moment_W =
        own * held.turning.cwiseProduct(cosserat::log_map(support.rotation.conjugate() * own));
  }
}

}  // namespace pedicel::simulation
