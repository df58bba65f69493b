#include "plugins/simulation/instrument.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "plugins/simulation/place.h"

namespace pedicel::simulation {

namespace {

constexpr double tare_time = 0.2;  // s

/// Another seed for each instrument of a run.
std::uint64_t seed_of(std::uint64_t run, const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325ull ^ run;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

}  // namespace

int link_of(const Simulation& simulation, const world::SceneInstrument& scene) {
  const int link = simulation.robot()->description().link(scene.link);
  if (link < 0)
    throw UsageError(scene.kind().name + " " + in_quotes(scene.name) + ": the robot has no link " +
                     in_quotes(scene.link));
  return link;
}

std::string own_frame_name(const world::SceneInstrument& scene) {
  return scene.name + "/" + scene.kind().name;
}

Seat::Seat(const Simulation& simulation, const world::SceneInstrument& scene)
    : simulation_(simulation), offset_(scene.pose) {
  if (!scene.link.empty()) {
    link_ = link_of(simulation, scene);
    return;
  }
  place_ = find_organ_place(simulation.rods(), scene.organ, scene.at);
  const cosserat::RodModel& model = simulation.rods().model(place_.plant);
  for (int f = 0; f < static_cast<int>(model.fruits.size()); ++f)
    if (fruit_name(model, f) == scene.organ) fruit_ = f;
}

std::optional<Pose> Seat::pose() {
  if (link_ >= 0) return simulation_.robot()->link_pose(link_) * offset_;
  const cosserat::RodState& state = simulation_.rods().state(place_.plant);
  const Pose now = Pose{cosserat::point_on(simulation_.rods().model(place_.plant), state,
                                           place_.element, place_.back),
                        state.orientation[place_.element]} *
                   offset_;
  const bool is_off = fruit_ >= 0 ? state.fruit_gone[fruit_] != 0 : !state.alive[place_.element];
  if (is_off) return pose_on_body(state, now);
  return last_ = now;
}

std::optional<Pose> Seat::pose_on_body(const cosserat::RodState& state, const Pose& now) {
  const world::SimWorld& world = simulation_.world();
  if (body_ < 0) {
    // What a cut takes off, it takes as the step before left it; a fruit comes off at a step's end.
    body_ = simulation_.cutting().body_with(place_.plant, place_.element);
    pose_B_ = last_;
    const auto& fruits = simulation_.rods().model(place_.plant).fruits;
    for (int f = 0; f < static_cast<int>(fruits.size()) && body_ < 0; ++f)
      if ((f == fruit_ || fruits[f].element == place_.element) && state.fruit_gone[f])
        if (const auto fallen = fallen_fruit(simulation_, place_.plant, f))
          body_ = fallen->body, pose_B_ = now;
    if (body_ < 0) return std::nullopt;
    pose_B_ = world.body(body_).pose.inverse() * pose_B_;
  }
  return world.body_pose(body_) * pose_B_;
}

Instrument::Instrument(const world::SceneInstrument& scene, int run_seed,
                       const std::string& noise_name, Gauge gauge)
    : scene_(scene),
      random_(seed_of(static_cast<std::uint64_t>(run_seed), noise_name)),
      gauge_(std::move(gauge)) {
  const long count = 3 * std::ssize(kind().vectors);
  exact_ = walk_ = reading_.value = Eigen::VectorXd::Zero(count);
  if (gauge_.bias.size() == 0) gauge_.bias = exact_;
  if (!scene.tared) tare_ = exact_;
  bias_ = drawn(&world::InstrumentNoise::Size::bias);
}

Eigen::VectorXd Instrument::drawn(double world::InstrumentNoise::Size::*size) {
  Eigen::VectorXd values(exact_.size());
  for (long i = 0; i < values.size(); ++i)
    values[i] = scene_.noise.sizes[static_cast<std::size_t>(i / 3)].*size * random_.normal();
  return values;
}

Eigen::VectorXd Instrument::noise(double dt) {
  walk_ += std::sqrt(dt) * drawn(&world::InstrumentNoise::Size::walk);
  return bias_ + walk_ + drawn(&world::InstrumentNoise::Size::std);
}

void Instrument::step(world::SimWorld& world) {
  const double time = world.time();
  measure(world, exact_);
  if (scene_.noise.latency > 0.0) {
    past_.emplace_back(time, exact_);
    while (past_.size() > 1 && past_[1].first <= time - scene_.noise.latency + 1.0e-9)
      past_.pop_front();
  }
  // The first sample at or after each multiple of the sampling time.
  const double due = std::floor(time * scene_.rate + 1.0e-6) / scene_.rate;
  new_.clear();
  if (due > last_sample_ + 0.5 / scene_.rate) sample(time);
  if (!tare_ && !untared_.empty() && time >= tare_time - 1.0e-9) tare();
}

const Eigen::VectorXd& Instrument::late(double time) const {
  if (past_.empty()) return exact_;
  const double shown = time - scene_.noise.latency + 1.0e-9;
  const auto later =
      std::ranges::find_if(past_, [&](const auto& one) { return one.first > shown; });
  return later == past_.begin() ? past_.front().second : std::prev(later)->second;
}

void Instrument::sample(double time) {
  const Sample taken{
      time, gauge_.gain * late(time) + gauge_.bias + noise(samples_ == 0 ? 0.0 : time - taken_at_)};
  taken_at_ = time;
  last_sample_ = std::floor(time * scene_.rate + 1.0e-6) / scene_.rate;
  ++samples_;
  if (!tare_) return untared_.push_back(taken);
  reading_ = {time, taken.value - *tare_};
  new_.push_back(reading_);
}

void Instrument::tare() {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(exact_.size());
  for (const Sample& one : untared_) sum += one.value;
  tare_ = sum / static_cast<double>(untared_.size());
  for (const Sample& one : untared_) new_.push_back({one.time, one.value - *tare_});
  reading_ = new_.back();
  untared_.clear();
}

Instruments::Instruments(Simulation& simulation, Diagnostics& diagnostics)
    : world_(simulation.world()) {
  for (const world::SceneInstrument& one : simulation.scene().instruments) try {
      if (!one.link.empty() && !simulation.robot()) continue;
      all_.push_back(maker_of(one.kind())(simulation, one));
    } catch (const UsageError& fault) {
      diagnostics.error(one.where, fault.what());
    }
}

void Instruments::observe(const world::SimWorld&, const world::WorldReport&) {
  for (const auto& one : all_) one->step(world_);
}

}  // namespace pedicel::simulation
