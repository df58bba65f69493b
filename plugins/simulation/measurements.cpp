#include "plugins/simulation/measurements.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::simulation {

namespace {

// No expectation holds for NaN, in whichever way it compares.
constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Measurements::Measurements(const cosserat::RodSystem& rods, const PlantStep& plants,
                           const coupling::ColliderSet& colliders)
    : rods_(rods), plants_(plants), colliders_(colliders), records_(rods.size()) {
  for (int p = 0; p < rods_.size(); ++p) {
    const cosserat::RodModel& model = rods_.model(p);
    for (const cosserat::Fruit& fruit : model.fruits)
      records_[p].fruit_start.push_back(
          cosserat::point_on(model, rods_.state(p), fruit.element, fruit.back).z());
    records_[p].fruit_top = records_[p].fruit_start;
    records_[p].fruit_force.assign(model.fruits.size(), 0.0);
  }
}

void Measurements::observe(const world::SimWorld& world, const world::WorldReport& report) {
  time_ = world.time();
  penetration_ = std::max(penetration_, report.deepest_overlap);
  rods_.each_plant([&](int p) { observe_plant(p); });
  // Its rise goes on being measured where it flies.
  for (const Detached& fruit : plants_.detached()) {
    double& top = records_[fruit.plant].fruit_top[fruit.event.fruit];
    top = std::max(top, world.body_pose(fruit.body).position.z());
  }
  for (int c = 0; c < colliders_.size(); ++c) {
    double& largest = link_force_[colliders_.collider(c).name];
    // By name: parts of a link count together as the largest of them.
    largest = std::max(largest, plants_.contacts().colliders()[c].normal);
  }
}

void Measurements::observe_plant(int plant) {
  const cosserat::RodModel& model = rods_.model(plant);
  const cosserat::RodState& state = rods_.state(plant);
  PlantRecord& record = records_[plant];
  double drift2 = 0.0, stretch2 = 0.0, bend2 = 0.0;  // squares; of bend: sine of half the angle
  int most_bent = -1;
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    // From the drawing, not from the first step: a plant that jumps at once has drifted.
    drift2 = std::max(drift2, (state.position[e] - model.elements[e].drawn_position).squaredNorm());
    stretch2 = std::max(stretch2, cosserat::stretch_of(model, state, e).squaredNorm());
    const double bent = cosserat::turn_of(model, state, e).vec().squaredNorm();
    if (!(bent > bend2)) continue;
    bend2 = bent;
    most_bent = e;
  }
  record.drift = std::max(record.drift, std::sqrt(drift2));
  record.stretch = std::max(record.stretch, std::sqrt(stretch2));
  // Its angle takes an arctangent, so that only one is computed.
  if (most_bent >= 0)
    record.bend = std::max(record.bend, cosserat::strain_of(model, state, most_bent).bend.norm());
  for (std::size_t f = 0; f < model.fruits.size(); ++f) {
    const cosserat::Fruit& fruit = model.fruits[f];
    record.fruit_force[f] =
        std::max(record.fruit_force[f], plants_.contacts().fruits(plant)[f].normal);
    if (state.fruit_gone[f]) continue;
    record.fruit_top[f] = std::max(record.fruit_top[f],
                                   cosserat::point_on(model, state, fruit.element, fruit.back).z());
  }
}

double Measurements::value(const world::Expectation& e, const world::SimWorld& world) const {
  const std::string& q = e.quantity;
  if (q == "detached_count") return count(e, "");
  if (q == "detached_by_stretch_count") return count(e, "stretch");
  if (q == "detached_by_bend_count") return count(e, "bend");
  if (q == "fruit_in") return fruits_in(e, world);
  if (q == "max_drift_m") return of_plants(e, &PlantRecord::drift);
  if (q == "max_stretch_1") return of_plants(e, &PlantRecord::stretch);
  if (q == "max_bend_rad") return of_plants(e, &PlantRecord::bend);
  if (q == "end_drop_m") return end_drop(e.plant);
  if (q == "max_contact_force_N") return contact_force(e);
  if (q == "max_penetration_m") return penetration_;
  if (q == "real_time_factor") return wall_seconds_ > 0.0 ? time_ / wall_seconds_ : not_measured;
  if (q == "kinetic_energy_J") {
    double sum = 0.0;
    for (int p = 0; p < rods_.size(); ++p)
      sum += cosserat::energy_of(rods_.model(p), rods_.state(p), Vec3::Zero()).kinetic;
    return sum;
  }
  return of_fruit(e, world);
}

double Measurements::of_fruit(const world::Expectation& e, const world::SimWorld& world) const {
  const Detached* detached = find_detached(e.fruit);
  // What never came off is not measured, so the expectation fails.
  if (e.quantity == "detach_time_s") return detached ? detached->event.time : not_measured;
  if (e.quantity == "detach_strain_1") return detached ? detached->event.stretch : not_measured;
  if (e.quantity == "detach_bend_rad") return detached ? detached->event.bend : not_measured;
  if (e.quantity == "detach_force_N") return detached ? detached->event.force : not_measured;
  for (int p = 0; p < rods_.size(); ++p) {
    const cosserat::RodModel& model = rods_.model(p);
    for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f) {
      if (fruit_name(model, f) != e.fruit) continue;
      if (e.quantity == "fruit_rise_m")
        // Also of one that fell down later.
        return records_[p].fruit_top[f] - records_[p].fruit_start[f];
      if (detached) return world.body_pose(detached->body).position.z();
      return cosserat::point_on(model, rods_.state(p), model.fruits[f].element,
                                model.fruits[f].back)
          .z();
    }
  }
  return not_measured;
}

const Detached* Measurements::find_detached(const std::string& fruit) const {
  for (const Detached& detached : plants_.detached())
    if (detached.fruit == fruit) return &detached;
  return nullptr;
}

bool Measurements::is_plant(const std::string& wanted, int plant) const {
  return wanted.empty() || rods_.model(plant).name == wanted;
}

double Measurements::count(const world::Expectation& e, const std::string& cause) const {
  return static_cast<double>(
      std::count_if(plants_.detached().begin(), plants_.detached().end(), [&](const Detached& d) {
        return is_plant(e.plant, d.plant) && (e.fruit.empty() || e.fruit == d.fruit) &&
               (cause.empty() || cause == d.event.cause);
      }));
}

double Measurements::of_plants(const world::Expectation& e, double PlantRecord::*value) const {
  double largest = not_measured;
  for (int p = 0; p < rods_.size(); ++p)
    if (is_plant(e.plant, p)) largest = std::fmax(largest, records_[p].*value);
  return largest;
}

double Measurements::fruits_in(const world::Expectation& e, const world::SimWorld& world) const {
  const int index = world.body_index(e.body);
  if (index < 0) return not_measured;
  const auto bounds = world::bounds_of(world.body(index));
  const Pose into = world.body_pose(index).inverse();
  return static_cast<double>(
      std::count_if(plants_.detached().begin(), plants_.detached().end(), [&](const Detached& d) {
        if (!e.fruit.empty() && e.fruit != d.fruit) return false;
        const Vec3 p = into * world.body_pose(d.body).position;
        // In the body's own frame, since a tray may have been moved.
        return (p.array() >= bounds.first.array()).all() &&
               (p.array() <= bounds.second.array()).all();
      }));
}

double Measurements::contact_force(const world::Expectation& e) const {
  double largest = 0.0;
  if (!e.fruit.empty()) {
    for (int p = 0; p < rods_.size(); ++p)
      for (std::size_t f = 0; f < rods_.model(p).fruits.size(); ++f)
        if (fruit_name(rods_.model(p), static_cast<int>(f)) == e.fruit)
          largest = std::max(largest, records_[p].fruit_force[f]);
    return largest;
  }
  for (const auto& [name, force] : link_force_)
    if (e.link.empty() || e.link == name || name.ends_with("/" + e.link))
      largest = std::max(largest, force);
  return largest;
}

double Measurements::end_drop(const std::string& plant) const {
  double sum = 0.0;
  int ends = 0;
  for (int p = 0; p < rods_.size(); ++p) {
    if (!is_plant(plant, p)) continue;
    const cosserat::RodModel& model = rods_.model(p);
    std::vector<char> carries(model.elements.size(), 0);
    for (const cosserat::Element& element : model.elements)
      if (element.parent >= 0) carries[element.parent] = 1;
    for (int e = 0; e < model.size(); ++e) {
      // Ends are what nothing grows from; a broken one is on the ground.
      if (carries[e] || !rods_.state(p).alive[e]) continue;
      sum += model.elements[e].drawn_position.z() - rods_.state(p).position[e].z();
      ++ends;
    }
  }
  return ends > 0 ? sum / ends : not_measured;
}

double Measurements::largest_stretch() const {
  double largest = 0.0;
  for (const PlantRecord& record : records_) largest = std::max(largest, record.stretch);
  return largest;
}

}  // namespace pedicel::simulation
