#include "plugins/simulation/plants/plant_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/csv.h"
#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/simulation/plants/folded_stem.h"

namespace pedicel::simulation {

namespace {

/// A single rough step is a knock; this many in a row are a run that has lost its way.
constexpr int most_rough_steps = 100;

// Far above what a strike can do: a run that is stopped in vain is worse than one that goes on for
// a few steps more.
constexpr double fastest = 1.0e4;  // m/s: beyond it nothing in a plant moves

/// The fastest element that is alive; -1 where none is.
int fastest_of(const cosserat::RodState& state) {
  int found = -1;
  for (int e = 0; e < state.size(); ++e)
    if (state.alive[e] &&
        (found < 0 || state.velocity[e].squaredNorm() > state.velocity[found].squaredNorm()))
      found = e;
  return found;
}

// A link that leaves a stem no room, against its clamp or the ground, leaves it no smooth
// equilibrium either: steps go to and fro about a kink of the potential, which keeps them in
// bounds. Such a run is inexact there (RoughSpell says so) but has not lost its way.
bool is_squeezed(const cosserat::StepReport& report,
                 const std::vector<cosserat::ContactForce>& contacts) {
  if (report.errors & cosserat::line_search_failed) return false;
  return std::ranges::any_of(contacts, [](const cosserat::ContactForce& contact) {
    return !cosserat::is_self_contact(contact.point.collider);
  });
}

std::string cause_of(const cosserat::StepReport& report, double speed, bool is_folded) {
  if (report.errors & cosserat::not_finite) return "a position is not a finite number";
  if (speed > fastest) return "it moves at " + io::format_number(speed, 3) + " m/s";
  if (is_folded) return std::string("it is ") + folded_text;
  return "no equilibrium found in " + std::to_string(most_rough_steps) +
         " steps in a row: the last change of position (m) or direction (rad) is " +
         io::format_number(report.last_change, 3);
}

}  // namespace

std::string fruit_name(const cosserat::RodModel& model, int fruit) {
  return model.name + "/" + model.fruits[fruit].name;
}

PlantStep::PlantStep(cosserat::RodSystem& rods, coupling::ColliderSet& colliders,
                     LinkPose link_pose)
    : rods_(rods), colliders_(colliders), link_pose_(std::move(link_pose)), contacts_(colliders) {
  // Before the first step nothing touches: who asks finds zeros.
  contacts_.begin();
  // Makes the lists of organs and fruits as long as they will be.
  for (int p = 0; p < rods_.size(); ++p) contacts_.add(p, rods_.model(p), {});
  contacts_.end();
}

void PlantStep::act(world::SimWorld& world, world::WorldReport& report) {
  // Bullet has moved the links; plants feel them where they are now.
  move_colliders();
  rods_.step(world.dt(), world.settings().gravity);
  // Allocates once. Plants do not come and go in a world that runs.
  tallies_.resize(rods_.size());
  sum_up(world.settings().gravity, report);
  // After the forces were summed up: the step in which it broke counts.
  // The body's own pushes begin in the next step: it was not there while Bullet moved.
  for (int p = 0; p < rods_.size(); ++p)
    for (const cosserat::DetachEvent& event : rods_.detached(p)) release(world, p, event);
  if (released_) contacts_.add_colliders();
  // Last, since it moves the links and bodies against which the plants were solved.
  if (reaction_) reaction_(contacts_);
}

void PlantStep::move_colliders() {
  poses_.resize(colliders_.size());
  for (int c = 0; c < colliders_.size(); ++c) poses_[c] = link_pose_(colliders_.collider(c));
  colliders_.update(poses_);
}

void PlantStep::sum_up(const Vec3& gravity, world::WorldReport& report) {
  rods_.each_plant([&](int p) {
    tallies_[p].energy = cosserat::energy_of(rods_.model(p), rods_.state(p), gravity).total();
  });
  contacts_.begin();
  for (int p = 0; p < rods_.size(); ++p) {
    contacts_.add(p, rods_.model(p), rods_.contact_forces(p));
    judge(p, report);
    const cosserat::StepReport& own = rods_.report(p);
    // A search that fails is as rough as one that ends too early.
    const bool rough = own.errors & (cosserat::not_converged | cosserat::line_search_failed);
    const bool counts = rough && !is_squeezed(own, rods_.contact_forces(p));
    tallies_[p].rough_steps = counts ? tallies_[p].rough_steps + 1 : 0;
    report.contacts += own.contacts;
    // The worst of all plants: one that is rough must not hide behind many that are not.
    report.plant_energy += tallies_[p].energy;
    report.deepest_overlap = std::max(report.deepest_overlap, own.deepest);
    report.worst_residual = std::max(report.worst_residual, own.last_change);
  }
  contacts_.end();
}

// Names the organ of the worst error, and of a fatal one the quantity.
void PlantStep::judge(int plant, world::WorldReport& report) const {
  const cosserat::StepReport& own = rods_.report(plant);
  const cosserat::RodModel& model = rods_.model(plant);
  const cosserat::RodState& state = rods_.state(plant);
  const int quickest = fastest_of(state);
  const double speed = quickest < 0 ? 0.0 : state.velocity[quickest].norm();
  // Speed is looked at as well: a run that flies apart may converge in each step.
  const bool lost = (own.errors & cosserat::not_finite) ||
                    tallies_[plant].rough_steps > most_rough_steps || speed > fastest;
  if (lost) report.errors |= world::plant_not_finite;
  if (own.errors & cosserat::not_converged) report.errors |= world::plant_not_converged;
  // The first culprit of a step stays, unless another plant is lost.
  if (!lost && (!own.errors || !report.culprit.empty())) return;
  // The element that the solver names is the one that it found hardest; where speed is what is
  // wrong, the quickest one is.
  const int folded = lost ? folded_element(model, state) : -1;
  const int element = folded >= 0                              ? folded
                      : own.element >= 0 && !(speed > fastest) ? own.element
                                                               : quickest;
  if (element >= 0) report.culprit = model.organs[model.elements[element].organ];
  if (lost) report.cause = cause_of(own, speed, folded >= 0);
}

void PlantStep::release(world::SimWorld& world, int plant, const cosserat::DetachEvent& event) {
  const cosserat::RodModel& model = rods_.model(plant);
  const cosserat::Fruit& fruit = model.fruits[event.fruit];
  Detached record{plant, event, fruit_name(model, event.fruit), -1, {}};
  // NaN says that there is none; zero would be a place.
  record.tool.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (tool_) record.tool = tool_();
  // Described by what the event recorded, since model and state have lost the fruit by now.
  world::BodyDescription body = world::fruit_body(record.fruit, fruit.radius, event.mass,
                                                  event.stub_length, event.stub_radius);
  // Where it hung: the body begins in the very place that the fruit leaves.
  body.pose = {event.position_W, event.orientation};
  // It goes on as it moved, so that a jerk is the plant's doing and not ours.
  body.velocity = event.velocity_W;
  body.angular_velocity = event.angular_velocity_W;
  // The world numbers it. Who hears of it gets the number with the record.
  record.body = world.add_body(body);
  detached_.push_back(std::move(record));
  if (released_) released_(detached_.back());
}

}  // namespace pedicel::simulation
