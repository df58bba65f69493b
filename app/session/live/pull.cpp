#include "app/session/live/pull.h"

#include <algorithm>
#include <cmath>

namespace pedicel::app {

void Pull::begin(const PullPlace& place, const Vec3& target_W) {
  end();
  const bool there = place.plant >= 0 && place.plant < simulation_.rods().size() &&
                     place.element >= 0 &&
                     place.element < simulation_.rods().model(place.plant).size();
  if (!there) return;
  place_ = place;
  target_W_ = target_W;
  if (on_plant())
    put_in();
  else
    find_body();
}

void Pull::move(const Vec3& target_W) {
  target_W_ = target_W;
  if (in_) simulation_.rods().supports(place_->plant).back().position = target_W;
}

void Pull::end() {
  take_out();
  place_.reset();
  body_ = -1;
}

void Pull::renew() {
  in_ = false;
  if (active() && on_plant()) put_in();
}

bool Pull::on_plant() const {
  return simulation_.rods().state(place_->plant).alive[place_->element];
}

void Pull::put_in() {
  cosserat::Support support;
  support.element = place_->element;
  support.back = place_->back;
  support.position = target_W_;
  support.rotation = simulation_.rods().state(place_->plant).orientation[place_->element];
  support.position_stiffness = place_->stiffness;
  simulation_.rods().supports(place_->plant).push_back(support);
  in_ = true;
}

void Pull::take_out() {
  if (in_) simulation_.rods().supports(place_->plant).pop_back();
  in_ = false;
}

// The body that the fruit on the pulled element has become.
void Pull::find_body() {
  for (const simulation::Detached& one : simulation_.plant_step().detached()) {
    if (one.plant != place_->plant || one.body < 0) continue;
    const cosserat::RodModel& model = simulation_.rods().model(one.plant);
    if (model.fruits[one.event.fruit].element != place_->element) continue;
    body_ = one.body;
    // The stub lies along the body's -Z, the fruit's centre at its origin.
    arm_ = Vec3(0, 0, model.fruits[one.event.fruit].back - place_->back);
  }
}

Vec3 Pull::point() const {
  if (body_ >= 0) return simulation_.world().body_pose(body_) * arm_;
  return cosserat::point_on(simulation_.rods().model(place_->plant),
                            simulation_.rods().state(place_->plant), place_->element, place_->back);
}

// Explicit, so no stiffer than w = 0.2 / dt allows for this mass, and critically damped.
Vec3 Pull::body_force() const {
  const world::SimWorld& world = simulation_.world();
  const double mass = world.body(body_).mass;
  const double stiffest = mass * std::pow(0.2 / world.dt(), 2);
  const double k = std::min(place_->stiffness, stiffest);
  return k * (target_W_ - point()) - 2.0 * std::sqrt(k * mass) * world.body_velocity(body_);
}

void Pull::act(world::SimWorld& world, world::WorldReport&) {
  if (!active()) return;
  if (in_ && !on_plant()) {
    take_out();
    find_body();
  }
  if (body_ >= 0 && world.body(body_).mass > 0.0) world.push_body(body_, body_force(), point());
}

PullSnapshot Pull::snapshot() const {
  PullSnapshot now;
  now.active = active();
  if (!active()) return now;
  const cosserat::RodModel& model = simulation_.rods().model(place_->plant);
  now.organ = model.organs[model.elements[place_->element].organ];
  now.target_W = target_W_;
  now.point_W = point();
  if (body_ >= 0)
    now.force_W = body_force();
  else if (in_)
    now.force_W = place_->stiffness * (target_W_ - now.point_W);
  return now;
}

}  // namespace pedicel::app
