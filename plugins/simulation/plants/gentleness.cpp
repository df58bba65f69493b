#include "plugins/simulation/plants/gentleness.h"

#include <algorithm>
#include <cmath>

namespace pedicel::simulation {

namespace {

/// s, after which strain energies are looked at again: all segments at every step would take 3 % of
/// a run's time.
constexpr double energy_interval = 0.05;

void add_contact(Gentleness::Record& record, double force, double time, double dt) {
  if (!(force > 0.0)) return;
  if (!record.touched()) record.first_touch = time;
  record.peak_force = std::max(record.peak_force, force);
  record.impulse += force * dt;
}

}  // namespace

Gentleness::Gentleness(const cosserat::RodSystem& rods, const PlantStep& plants)
    : rods_(rods), step_(plants), plants_(static_cast<std::size_t>(rods.size())) {
  for (int p = 0; p < rods.size(); ++p) {
    Plant& plant = plants_[p];
    plant.organs.resize(rods.model(p).organs.size());
    plant.fruits.resize(rods.model(p).fruits.size());
    plant.start.resize(plant.organs.size());
    plant.now.resize(plant.organs.size());
    sum_energy(p, plant.start);
  }
}

void Gentleness::observe(const world::SimWorld& world, const world::WorldReport&) {
  const long every = std::max(1l, std::lround(energy_interval / world.dt()));
  for (int p = 0; p < rods_.size(); ++p) {
    observe_contacts(p, world.time(), world.dt());
    if (steps_ % every == 0) observe_energy(p);
  }
  ++steps_;
}

void Gentleness::observe_contacts(int p, double time, double dt) {
  Plant& plant = plants_[p];
  const cosserat::RodModel& model = rods_.model(p);
  const cosserat::RodState& state = rods_.state(p);
  const auto& organs = step_.contacts().organs(p);
  for (std::size_t o = 0; o < plant.organs.size(); ++o)
    add_contact(plant.organs[o], organs[o].normal, time, dt);
  const auto& fruits = step_.contacts().fruits(p);
  for (std::size_t f = 0; f < plant.fruits.size(); ++f) {
    Record& record = plant.fruits[f];
    add_contact(record, fruits[f].normal, time, dt);
    if (record.broken) continue;
    record.broken = state.fruit_gone[f];
    record.margin_used = record.broken
                             ? 1.0
                             : std::max(record.margin_used,
                                        cosserat::margin_used(model, state, static_cast<int>(f)));
    if (!record.broken) continue;
    const int element = model.fruits[f].element;
    if (!state.alive[element]) plant.organs[model.elements[element].organ].broken = true;
  }
}

void Gentleness::observe_energy(int p) {
  Plant& plant = plants_[p];
  std::ranges::fill(plant.now, 0.0);
  sum_energy(p, plant.now);
  for (std::size_t o = 0; o < plant.organs.size(); ++o) {
    double& most = plant.organs[o].strain_energy;
    most = std::max(most, plant.now[o] - plant.start[o]);
  }
}

/// Half of load times strain: exact for linear tissue.
void Gentleness::sum_energy(int p, std::vector<double>& sums) const {
  const cosserat::RodModel& model = rods_.model(p);
  const cosserat::RodState& state = rods_.state(p);
  for (int e = 0; e < model.size(); ++e) {
    if (!state.alive[e]) continue;
    const cosserat::Strain strain = cosserat::strain_of(model, state, e);
    const cosserat::JointLoad load = cosserat::joint_load(model, state, e);
    sums[model.elements[e].organ] +=
        0.5 *
        (model.elements[e].length * load.force.dot(strain.stretch) + load.moment.dot(strain.bend));
  }
}

Gentleness::Total Gentleness::total() const {
  Total total;
  const auto add = [&](const Record& one) {
    total.peak_force = std::max(total.peak_force, one.peak_force);
    total.margin_used = std::max(total.margin_used, one.margin_used);
    total.strain_energy += one.strain_energy;
    total.touched += one.touched();
  };
  for (const Plant& plant : plants_) {
    for (const Record& one : plant.organs) add(one), total.impulse += one.impulse;
    // A fruit's contacts count for the organ that carries it, too.
    for (const Record& one : plant.fruits) add(one), total.broken += one.broken;
  }
  return total;
}

}  // namespace pedicel::simulation
