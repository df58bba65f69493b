#pragma once

#include <cmath>
#include <string>

#include "plugins/discrepancy/data/experiment.h"

/// A straight round stem that stands on its clamp, unloaded, with markers along it.
namespace pedicel::discrepancy::testing {

struct Beam {
  double length = 0.4, radius = 0.003;  // m
  double modulus = 2.0e8;               // Pa
  double density = 800.0;               // kg/m3
  double damping_time = 0.0;            // s

  double stiffness() const { return modulus * 0.25 * M_PI * std::pow(radius, 4); }  // N m2
  double mass_per_length() const { return density * M_PI * radius * radius; }       // kg/m
  /// N/m, of its tip across.
  double tip_stiffness() const { return 3.0 * stiffness() / std::pow(length, 3); }
};

inline plant::PlantFile plant_of(const Beam& beam) {
  plant::PlantFile plant;
  plant.name = "beam";
  plant.shape = plant::Shape::rest;
  plant.material = {beam.modulus, 0.3, beam.density, beam.damping_time};
  plant.connect = 0.01;
  plant.distance = 0.02;
  plant::PlantCurve curve;
  curve.name = "stem";
  curve.interpolation = plant::Interpolation::linear;
  curve.points = {Vec3(0, 0, 0), Vec3(0, 0, beam.length)};
  curve.radius = {beam.radius};
  plant.curves = {curve};
  return plant;
}

inline plant::CurvePlace on_stem(double at) {
  return {"stem", at, {}};
}

inline plant::Effect effect(const std::string& name, const std::string& parameter,
                            std::vector<double> value) {
  plant::Effect made;
  made.name = name;
  made.numbers[parameter] = std::move(value);
  return made;
}

/// Sample times 0, step, ..., `duration`; nothing measured yet.
inline Samples empty_samples(double duration, double step, int columns) {
  Samples samples;
  const int count = static_cast<int>(std::lround(duration / step)) + 1;
  for (int i = 0; i < count; ++i) samples.time.push_back(i * step);
  samples.value.setZero(count, columns);
  return samples;
}

/// One trial without gravity and drives, markers at 0.5 and 1, a force that is measured.
inline Experiment experiment_of(const Beam& beam, double duration, double step = 0.01) {
  Experiment experiment;
  experiment.plant() = plant_of(beam);
  experiment.markers = {{"middle", on_stem(0.5)}, {"tip", on_stem(1.0)}};
  Trial trial;
  trial.name = "one";
  trial.gravity.setZero();
  trial.markers = empty_samples(duration, step, 6);
  trial.force = empty_samples(duration, step, 3);
  experiment.trials = {trial};
  return experiment;
}

/// A path that rests at `offset` (m) from a beam's place, across it.
inline DrivenPath resting_at(const Vec3& point) {
  return {{0.0}, {point}, {}};
}

}  // namespace pedicel::discrepancy::testing
