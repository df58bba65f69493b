#pragma once

#include <cmath>
#include <functional>

#include "engine/core/random.h"
#include "plugins/discrepancy/admission/nominal_plant.h"
#include "plugins/discrepancy/simulate/simulator.h"

/// A day in a laboratory: a stem with two branches, nine markers; let go along x and y, weights
/// hung on from the side, and pushed with the force measured. Simulated, with noise on top; nothing
/// is wrong.
namespace pedicel::discrepancy::laboratory {

inline constexpr double position_std = 3e-4, force_std = 1e-2;  // m, N
inline constexpr double step = 0.02;                            // s
enum TrialIndex { release_x, release_y, weights, push };

inline plant::PlantCurve curve(const std::string& name, std::vector<Vec3> points,
                               std::vector<double> radius) {
  plant::PlantCurve made;
  made.name = name;
  made.interpolation = plant::Interpolation::linear;
  made.points = std::move(points);
  made.radius = std::move(radius);
  return made;
}

inline plant::PlantFile plant_file() {
  plant::PlantFile plant;
  plant.name = "stem with two branches";
  plant.shape = plant::Shape::rest;
  plant.material = {5e8, 0.35, 700, 0.01};
  plant.connect = 0.01;
  plant.distance = 0.02;
  const Vec3 low(0.02, 0.01, 0.2), high(0.05, 0.014, 0.4);
  plant.curves = {
      curve("stem", {{0, 0, 0}, low, high, {0.11, 0.002, 0.6}}, {0.0045, 0.004, 0.0035, 0.003}),
      curve("branch1", {low, {0.08, 0.1, 0.24}, {0.14, 0.2, 0.23}}, {0.0027, 0.002, 0.0015}),
      curve("branch2", {high, {-0.05, -0.015, 0.43}, {-0.15, -0.04, 0.42}},
            {0.0027, 0.002, 0.0015})};
  return plant;
}

// 0 to 1 without a kink.
inline double ease(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

inline Hold hold_along(const Vec3& start, const Vec3& way, double until,
                       const std::function<double(double)>& share) {
  Hold hold;
  hold.place = {"stem", 0.8, {}};
  hold.stiffness = 150.0;
  hold.path.file = "hold.csv";
  for (int i = 0; i <= std::lround(until / step); ++i) {
    hold.path.time.push_back(i * step);
    hold.path.position.push_back(start + share(i * step) * way);
  }
  return hold;
}

inline void add_samples(Samples& samples, double until, Eigen::Index columns) {
  for (int i = 0; i <= std::lround(until / step); ++i) samples.time.push_back(i * step);
  samples.value.setZero(samples.size(), columns);
}

inline Vec3 held_point(const Experiment& experiment, const Vec3& gravity = {0, 0, -9.81}) {
  return NominalPlant::of(experiment, gravity)->spot({"stem", 0.8, {}}).settled;
}

inline void add_trials(Experiment& experiment) {
  const Vec3 start = held_point(experiment);
  const auto begin = [&](const std::string& name, double until) -> Trial& {
    Trial trial;
    trial.name = name;
    trial.folder = name;
    add_samples(trial.markers, until, 3 * static_cast<Eigen::Index>(experiment.markers.size()));
    experiment.trials.push_back(std::move(trial));
    return experiment.trials.back();
  };
  for (const bool along_x : {true, false}) {
    Trial& trial = begin(along_x ? "release_x" : "release_y", 4.0);
    trial.holds = {hold_along(start, 0.06 * (along_x ? Vec3::UnitX() : Vec3::UnitY()), 1.0,
                              [](double t) { return ease(t / 0.8); })};
    trial.holds[0].release = 1.0;
    add_samples(trial.force, 4.0, 3);
  }
  Trial& hung = begin("weights", 12.0);
  for (int i = 1; i < 4; ++i)
    hung.loads.push_back(
        {{"stem", 1.0, {}}, Vec3(i == 3 ? 0.03 : 0.03 * i, 0, 0), 3.0 * i, 3.0 * i + 3.0});
  Trial& pushed = begin("push", 8.0);
  pushed.holds = {hold_along(start, 0.08 * Vec3::UnitX(), 8.0,
                             [](double t) { return 0.5 - 0.5 * std::cos(2.0 * M_PI * t / 4.0); })};
  add_samples(pushed.force, 8.0, 3);
}

/// Fills the tables of all trials, with something hidden in the plant, the grip or the instruments.
inline void measure(Experiment& experiment, const std::vector<plant::Effect>& hidden) {
  Simulator simulator(experiment, {0.02, 1.0 / 240}, 1);
  const Variant variant{hidden, {}};
  Random random(5);
  for (int t = 0; t < static_cast<int>(experiment.trials.size()); ++t) {
    const Simulator::Request request{&variant, t};
    const Prediction seen = simulator.run({&request, 1}).front();
    Trial& trial = experiment.trials[t];
    trial.markers.value = seen.markers;
    trial.force.value = seen.force;
    for (double& x : trial.markers.value.reshaped()) x += position_std * random.normal();
    for (double& f : trial.force.value.reshaped()) f += force_std * random.normal();
  }
}

/// With something hidden in the plant, the grip or the instruments.
inline Experiment measured(const std::vector<plant::Effect>& hidden = {}) {
  Experiment experiment;
  experiment.title = "a day in a laboratory";
  experiment.folder = "day";
  experiment.plant() = plant_file();
  const auto mark = [&](const std::string& curve, std::initializer_list<double> places) {
    for (const double at : places)
      experiment.markers.push_back(
          {"m" + std::to_string(experiment.markers.size() + 1), {curve, at, {}}});
  };
  mark("stem", {0.2, 0.4, 0.6, 0.8, 1.0});
  mark("branch1", {0.5, 1.0});
  mark("branch2", {0.5, 1.0});
  experiment.noise = {position_std, force_std};
  add_trials(experiment);
  measure(experiment, hidden);
  return experiment;
}

/// A copy of the same day.
inline Experiment day() {
  static const Experiment experiment = measured();
  return experiment;
}

/// Every seen point through `change`.
inline void change_points(Trial& trial, const std::function<Vec3(const Vec3&)>& change) {
  for (Eigen::Index row = 0; row < trial.markers.value.rows(); ++row)
    for (Eigen::Index c = 0; c + 3 <= trial.markers.value.cols(); c += 3) {
      const Vec3 x = trial.markers.value.block<1, 3>(row, c).transpose();
      trial.markers.value.block<1, 3>(row, c) = change(x).transpose();
    }
}

}  // namespace pedicel::discrepancy::laboratory
