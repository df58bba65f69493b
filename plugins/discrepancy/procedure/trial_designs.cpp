#include "plugins/discrepancy/procedure/trial_designs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr double hour = 3600.0;

std::string millimetres(double m) {
  return short_number(1e3 * m) + " mm";
}

std::string place_words(const plant::CurvePlace& place) {
  return place.curve + " at " + short_number(place.at);
}

/// Makes the trials of one experiment.
class Designs {
 public:
  Designs(const Experiment& experiment, const DesignScales& scales)
      : experiment_(experiment), scales_(scales) {}

  std::vector<TrialDesign> run() {
    const double reach = scales_.reach;
    release(Vec3::UnitX(), "x", 0.5 * reach, 2.0);
    release(Vec3::UnitX(), "x", 1.5 * reach, 2.0);
    release(Vec3::UnitY(), "y", 0.5 * reach, 2.0);
    release(Vec3::UnitY(), "y", 1.5 * reach, 2.0);
    push("quickly", 0.5, 5.0, 3.0);
    push("slowly", 5.0, 60.0, 5.0);
    weights(scales_.grip.curve, 1.0);
    weights(scales_.grip.curve, 0.5);
    shake();
    turn();
    later();
    return std::move(designs_);
  }

 private:
  TrialDesign& add(const std::string& action, double duration, double minutes, bool force) {
    TrialDesign design;
    design.action = action;
    design.minutes = minutes;
    Trial& trial = design.trial;
    trial.name = "design" + std::to_string(designs_.size() + 1);
    trial.clock = scales_.last_clock;
    if (!experiment_.trials.empty()) trial.gravity = experiment_.trials.front().gravity;
    // Long trials are sampled as coarsely as their slow part allows.
    const double step = std::max(scales_.sample_time, duration / 1000.0);
    const int n = static_cast<int>(duration / step) + 1;
    for (int i = 0; i < n; ++i) trial.markers.time.push_back(step * i);
    const auto columns = static_cast<Eigen::Index>(3 * experiment_.markers.size());
    trial.markers.value = Eigen::MatrixXd::Zero(n, columns);
    if (force && scales_.force) {
      trial.force.time = trial.markers.time;
      trial.force.value = Eigen::MatrixXd::Zero(n, 3);
    }
    designs_.push_back(std::move(design));
    return designs_.back();
  }

  void hold(Trial& trial, std::vector<double> time, const std::vector<Vec3>& away, double release,
            const Vec3& rest) const {
    Hold one;
    one.place = scales_.grip;
    one.path.time = std::move(time);
    for (const Vec3& d : away) one.path.position.push_back(rest + d);
    one.release = release;
    if (scales_.stiffness > 0.0) one.stiffness = scales_.stiffness;
    trial.holds.push_back(one);
  }

  void release(const Vec3& along, const std::string& axis, double reach, double minutes) {
    TrialDesign& design = add("Pull " + place_words(scales_.grip) + " along " + axis + " by " +
                                  millimetres(reach) + " and let go",
                              6.0, minutes, false);
    hold(design.trial, {0.0}, {reach * along}, 1.0, scales_.rest);
  }

  void push(const std::string& how, double ramp, double rest, double minutes) {
    const Vec3 d = scales_.reach * Vec3::UnitX();
    TrialDesign& design = add(
        "Push " + place_words(scales_.grip) + " " + how + " (in " + short_number(ramp) +
            " s) along x by " + millimetres(scales_.reach) + ", hold for " + short_number(rest) +
            " s and come back" + (scales_.force ? ", with the force measured" : ""),
        2.0 * ramp + rest + 1.0, minutes, true);
    hold(design.trial, {0.0, 0.5, 0.5 + ramp, 0.5 + ramp + rest, 0.5 + 2.0 * ramp + rest},
         {Vec3::Zero(), Vec3::Zero(), d, d, Vec3::Zero()}, std::numeric_limits<double>::infinity(),
         scales_.rest);
  }

  // Up and down again, so that what does not come back shows.
  void weights(const std::string& curve, double at) {
    const plant::CurvePlace place{curve, at, {}};
    // The same moment at the root, wherever it acts.
    const double f = scales_.load / at;
    TrialDesign& design = add("Load " + place_words(place) + " sideways with " + short_number(f) +
                                  " N in two steps, and unload it in two steps, 4 s each",
                              20.0, 6.0, false);
    design.trial.loads = {{place, 0.5 * f * Vec3::UnitX(), 4.0, 8.0},
                          {place, f * Vec3::UnitX(), 8.0, 12.0},
                          {place, 0.5 * f * Vec3::UnitX(), 12.0, 16.0}};
  }

  // A sweep whose frequency rises evenly from 0.3 to 5 Hz.
  void shake() {
    const double amplitude = 0.1 * scales_.reach, duration = 12.0;
    TrialDesign& design = add("Shake the root along x by " + millimetres(amplitude) +
                                  " from 0.3 to 5 Hz in " + short_number(duration) + " s",
                              duration, 10.0, false);
    DrivenPath path;
    for (double t = 0.0; t <= duration; t += 0.01) {
      const double phase = 2.0 * std::numbers::pi * (0.3 * t + 0.5 * 4.7 * t * t / duration);
      path.time.push_back(t);
      path.position.push_back(experiment_.plant().root +
                              amplitude * std::sin(phase) * Vec3::UnitX());
    }
    design.trial.base = path;
  }

  void turn() {
    TrialDesign& design = add(
        "Turn the plant with its pot by 180 degrees about the vertical, pull " +
            place_words(scales_.grip) + " along x by " + millimetres(scales_.reach) + " and let go",
        6.0, 10.0, false);
    design.turned = true;
    hold(design.trial, {0.0}, {scales_.reach * Vec3::UnitX()}, 1.0, scales_.turned_rest);
  }

  void later() {
    TrialDesign& design = add("Wait for an hour, pull " + place_words(scales_.grip) +
                                  " along x by " + millimetres(scales_.reach) + " and let go",
                              6.0, 15.0, false);
    design.trial.clock += hour;
    hold(design.trial, {0.0}, {scales_.reach * Vec3::UnitX()}, 1.0, scales_.rest);
  }

  const Experiment& experiment_;
  const DesignScales& scales_;
  std::vector<TrialDesign> designs_;
};

// m, between the farthest poses of a path; a held pull has but one pose, and counts by force.
double travel(const DrivenPath& path) {
  double most = 0.0;
  for (const Vec3& p : path.position) most = std::max(most, (p - path.position.front()).norm());
  return most;
}

const MarkerChain& longest(const std::vector<MarkerChain>& chains) {
  return *std::ranges::max_element(chains, {}, &MarkerChain::length);
}

// How far the markers went in a trial, the largest.
double marker_travel(const Trial& trial) {
  double most = 0.0;
  for (Eigen::Index c = 0; c < trial.markers.value.cols(); ++c) {
    double low = 1e300, high = -1e300;
    for (const double x : trial.markers.value.col(c))
      if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
    most = std::max(most, high - low);
  }
  return most;
}

Vec3 turned(const Vec3& v) {
  return Vec3(-v.x(), -v.y(), v.z());
}

}  // namespace

DesignScales design_scales(const Experiment& experiment) {
  const std::vector<MarkerChain> chains = chains_of(experiment);
  const MarkerChain& main = longest(chains);
  DesignScales scales;
  scales.grip = {experiment.plant().curves[main.curve].name, 0.8, {}};
  for (const Trial& trial : experiment.trials) {
    scales.force = scales.force || trial.force.size() > 0;
    scales.last_clock = std::max(scales.last_clock, trial.clock + trial.duration());
    const Samples& m = trial.markers;
    if (m.size() > 1 && !trial.is_static)
      scales.sample_time = (m.time.back() - m.time.front()) / (m.size() - 1);
    for (const Hold& hold : trial.holds) {
      scales.grip = hold.place;
      scales.stiffness = hold.stiffness.value_or(0.0);
      // A swing goes as far back as it was pulled.
      scales.reach =
          std::max(scales.reach, std::max(travel(hold.path), 0.5 * marker_travel(trial)));
    }
    for (const TimedLoad& load : trial.loads)
      scales.load = std::max(scales.load, load.force.norm());
  }
  if (scales.reach <= 0.0) scales.reach = 0.1 * main.length;
  scales.reach = std::min(scales.reach, 0.2 * main.length);
  scales.sample_time = std::clamp(scales.sample_time, 0.005, 0.05);
  if (scales.load > 0.0) return scales;
  // A cantilever's tip moves by F l^3 / (3 E I).
  const plant::PlantCurve& curve = experiment.plant().curves[main.curve];
  const double modulus = curve.material.youngs_modulus.value_or(
      experiment.plant().material.youngs_modulus.value_or(1e8));
  const double radius = curve.radius.empty() ? 1e-3 : curve.radius.front();
  const double bend = modulus * std::numbers::pi / 4.0 * std::pow(radius, 4);
  scales.load = 3.0 * bend * scales.reach / std::pow(main.length, 3);
  return scales;
}

std::vector<TrialDesign> trial_designs(const Experiment& experiment, const DesignScales& scales) {
  return Designs(experiment, scales).run();
}

plant::PlantFile turned_plant(const plant::PlantFile& plant) {
  plant::PlantFile result = plant;
  const auto about_root = [&](const Vec3& p) -> Vec3 {
    return plant.root + turned(p - plant.root);
  };
  for (plant::PlantCurve& curve : result.curves) {
    for (Vec3& p : curve.points) p = about_root(p);
    curve.section.normal = turned(curve.section.normal);
  }
  for (plant::PlantLeaf& leaf : result.leaves) {
    leaf.normal = turned(leaf.normal);
    if (leaf.direction) leaf.direction = turned(*leaf.direction);
  }
  return result;
}

}  // namespace pedicel::discrepancy
