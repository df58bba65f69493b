#pragma once

#include <cmath>
#include <functional>

#include "engine/core/random.h"
#include "plugins/discrepancy/test/symptoms.h"

namespace pedicel::discrepancy {

/// An experiment whose "simulation" is written down in closed form, so that residuals of known size
/// can be laid on top: a stem of 0.6 m with a branch from its middle, markers every 0.15 m, and a
/// release, weights, and a push, at 50 Hz.
struct MadeData {
  static constexpr double frequency = 2.0, damping = 0.03;  // of the release
  static constexpr double stiffness = 2.0;                  // N/m, of the push
  static constexpr double position_std = 3e-4, force_std = 1e-2;

  Experiment experiment;
  std::vector<Prediction> predictions;

  MadeData() {
    experiment.title = "made";
    experiment.plant().name = "stem & branch";
    experiment.plant().curves = {curve("stem", {0, 0, 0}, {0, 0, 0.6}),
                                 curve("branch", {0, 0, 0.3}, {0.2, 0, 0.4})};
    for (const double at : {0.25, 0.5, 0.75, 1.0})
      experiment.markers.push_back(
          {"m" + std::to_string(experiment.markers.size() + 1), {"stem", at, {}}});
    experiment.markers.push_back({"m5", {"branch", 0.5, {}}});
    experiment.markers.push_back({"m6", {"branch", 1.0, {}}});
    add_release();
    add_weights();
    add_push();
  }

  Vec3 drawn(int marker) const {
    const plant::CurvePlace& place = experiment.markers[marker].place;
    const plant::PlantCurve& c = experiment.plant().curves[place.curve == "stem" ? 0 : 1];
    return c.points.front() + place.at * (c.points.back() - c.points.front());
  }

  /// Adds to the measured position of a marker a function of time and predicted position.
  using Change = std::function<Vec3(int trial, double t, int marker, const Vec3& predicted)>;
  void change(const Change& by) {
    for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
      Samples& s = experiment.trials[t].markers;
      for (int i = 0; i < s.size(); ++i)
        for (std::size_t m = 0; m < experiment.markers.size(); ++m)
          s.value.row(i).segment<3>(3 * m) +=
              by(static_cast<int>(t), s.time[i], static_cast<int>(m),
                 predictions[t].markers.row(i).segment<3>(3 * m).transpose())
                  .transpose();
    }
  }

  /// First-order autoregressive noise with the lag-one correlation `correlation`.
  void add_noise(std::uint64_t seed, double correlation = 0.0) {
    Random random(seed);
    const auto series = [&](auto column, double std) {
      double e = std * random.normal();
      for (Eigen::Index i = 0; i < column.size(); ++i) {
        column[i] += e;
        e = correlation * e + std * std::sqrt(1.0 - correlation * correlation) * random.normal();
      }
    };
    for (Trial& trial : experiment.trials) {
      for (Eigen::Index c = 0; c < trial.markers.value.cols(); ++c)
        series(trial.markers.value.col(c), position_std);
      for (Eigen::Index c = 0; c < trial.force.value.cols(); ++c)
        series(trial.force.value.col(c), force_std);
    }
  }

  static Noise noise_of(double std, double correlation) {
    if (correlation == 0.0) return white_noise(std);
    const double c[] = {std * std, correlation * std * std};
    return autoregressive(c, 1e6);
  }

  std::vector<Symptom> symptoms(double correlation = 0.0) const {
    DataSet data(experiment);
    data.set_noise(noise_of(position_std, correlation), noise_of(force_std, correlation));
    return pedicel::discrepancy::symptoms(experiment, data, predictions);
  }

 private:
  static plant::PlantCurve curve(const std::string& name, const Vec3& a, const Vec3& b) {
    plant::PlantCurve c;
    c.name = name;
    c.interpolation = plant::Interpolation::linear;
    c.points = {a, b};
    c.radius = {0.003};
    return c;
  }

  // Displacement along x of a marker that stands `height` above the root, for one unit at the top.
  static double shape(double height) { return std::pow(height / 0.6, 2); }

  void fill(Trial trial, double duration, const std::function<double(double)>& top,
            const std::function<double(double)>& rate) {
    const int n = static_cast<int>(std::lround(duration * 50.0)) + 1;
    Prediction p;
    p.markers.resize(n, 3 * experiment.markers.size());
    p.marker_velocity = Eigen::MatrixXd::Zero(n, p.markers.cols());
    for (int i = 0; i < n; ++i) {
      const double t = i / 50.0;
      trial.markers.time.push_back(t);
      for (std::size_t m = 0; m < experiment.markers.size(); ++m) {
        const Vec3 x = drawn(static_cast<int>(m));
        p.markers.row(i).segment<3>(3 * m) = (x + Vec3(shape(x.z()) * top(t), 0, 0)).transpose();
        p.marker_velocity(i, 3 * m) = shape(x.z()) * rate(t);
      }
    }
    trial.markers.value = p.markers;
    if (!trial.holds.empty() && trial.force.time.empty() && std::isinf(trial.holds[0].release)) {
      trial.force.time = trial.markers.time;
      p.force = Eigen::MatrixXd::Zero(n, 3);
      for (int i = 0; i < n; ++i)
        p.force(i, 0) = stiffness * trial.holds[0].path.position_at(trial.markers.time[i]).x();
      trial.force.value = p.force;
    }
    experiment.trials.push_back(std::move(trial));
    predictions.push_back(std::move(p));
  }

  void add_release() {
    Trial trial;
    trial.name = "release";
    Hold hold;
    hold.place = {"stem", 1.0, {}};
    hold.path = {{0.0}, {Vec3(0.04, 0, 0.6)}, {}};
    hold.release = 1.0;
    trial.holds.push_back(hold);
    const double w = 2 * M_PI * frequency, d = w * damping / std::sqrt(1 - damping * damping);
    fill(
        trial, 6.0,
        [=](double t) {
          return t < 1 ? 0.04 : 0.04 * std::exp(-d * (t - 1)) * std::cos(w * (t - 1));
        },
        [=](double t) {
          return t < 1 ? 0.0
                       : 0.04 * std::exp(-d * (t - 1)) *
                             (-d * std::cos(w * (t - 1)) - w * std::sin(w * (t - 1)));
        });
  }

  void add_weights() {
    Trial trial;
    trial.name = "weights";
    trial.clock = 100.0;
    trial.loads.push_back({{"stem", 1.0, {}}, Vec3(0.05, 0, 0), 4.0, 8.0});
    fill(
        trial, 8.0, [](double t) { return t < 4.0 ? 0.0 : 0.03; }, [](double) { return 0.0; });
  }

  void add_push() {
    Trial trial;
    trial.name = "push";
    trial.clock = 200.0;
    Hold hold;
    hold.place = {"stem", 1.0, {}};
    hold.path = {{0, 2, 5, 7},
                 {Vec3(0, 0, 0.6), Vec3(0.04, 0, 0.6), Vec3(0.04, 0, 0.6), Vec3(0, 0, 0.6)},
                 {}};
    trial.holds.push_back(hold);
    const DrivenPath path = hold.path;
    fill(
        trial, 7.0, [path](double t) { return path.position_at(t).x(); },
        [](double t) { return t < 2   ? 0.02
                              : t < 5 ? 0.0
                                      : -0.02; });
  }
};

/// The strongest symptom of a name; nothing where there is none.
inline const Symptom* strongest(const std::vector<Symptom>& all, const std::string& name) {
  const Symptom* best = nullptr;
  for (const Symptom& symptom : all)
    if (symptom.name == name && (!best || symptom.significance() > best->significance()))
      best = &symptom;
  return best;
}

}  // namespace pedicel::discrepancy
