#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/simulate/stalk_loads.h"

namespace pedicel::discrepancy {

/// Mesh and step of a prediction.
struct Numerics {
  double distance = 0.01;  ///< m between nodes, in place of the plant file's
  double dt = 1.0 / 960;   ///< s
  /// 1, of `distance`: the short segment below a junction (plant::BuildOptions). 0: none, and the
  /// branches' places err with the first power of `distance`.
  double junction = 0.05;
  /// Steps that are taken as one where nothing moves (quiet_spans); a power of two. 1: nowhere.
  int quiet = 1;

  bool operator==(const Numerics&) const = default;
};

/// A force that no known effect gives, evaluated at the start of each step: N in W, from time (s),
/// position (m, W) and velocity (m/s, W) of its point.
struct PointForce {
  plant::CurvePlace place;
  std::function<Vec3(double t, const Vec3& position, const Vec3& velocity)> law;
  std::string trial;  ///< it acts in that one alone; empty: in all
};

/// What one prediction is made of, on top of what the experiment states. Effects of the plant, the
/// grip and the sensor alike; `youngs_modulus`, `density` and `damping_time` with their `factor`
/// are effects, too.
struct Variant {
  std::vector<plant::Effect> effects;
  std::vector<PointForce> forces;
  /// Added to the amplitudes (MovingStart) with which trials begin that begin in motion; empty:
  /// nothing is.
  std::vector<double> start_shift{};
};

/// What the trial's instruments would have seen, at the trial's own sample times.
struct Prediction {
  Eigen::MatrixXd markers;  ///< samples x 3 markers, m, W
  Eigen::MatrixXd force;    ///< samples x 3, N, W; empty where the trial has none
  /// Of the plant itself, without the sensor's effects, for plots: velocity of the markers, m/s.
  Eigen::MatrixXd marker_velocity;
  bool healthy = true;  ///< false: the simulation failed; the rest is NaN from there on
  /// Fruits that came off: when the experiment recorded it where it did so, else when a threshold
  /// was passed.
  std::vector<MeasuredEvent> events;
  Eigen::MatrixXd wrench{};  ///< samples x 6, N and N m, W; empty where the trial has none
};

/// Simulates an experiment's trials with many variants of the model side by side: up to eight equal
/// plants share the solver's lanes, and groups of them run on all threads.
class Simulator {
 public:
  /// Keeps a reference to the experiment. Once `stop` is set, by whomever, run() returns early:
  /// everything not done is NaN and unhealthy.
  /// Throws InvalidFile where the plant cannot be built, UsageError where the experiment names a
  /// curve that it lacks.
  Simulator(const Experiment& experiment, const Numerics& numerics, int threads,
            const std::atomic<bool>* stop = nullptr);
  ~Simulator();

  struct Request {
    const Variant* variant = nullptr;
    int trial = 0;
    double until = std::numeric_limits<double>::infinity();  ///< s; later samples stay NaN
  };
  /// One prediction a request, in their order; the result depends on nothing but the request.
  /// Requests that differ only in effects of the sensor share one simulation, also with those of
  /// earlier calls as long as memory lasts. Throws UsageError where an effect cannot be simulated;
  /// effects that are only impossible together give a prediction that is not healthy.
  std::vector<Prediction> run(std::span<const Request> requests);

  /// The forces (N, W) that springs of `stiffness` (N/m) from each marker to its measured path
  /// would have to give the model, so that it follows the data: rows as the trial's marker samples,
  /// 3 columns a marker. Where a marker is not seen its spring is off.
  Eigen::MatrixXd tracking_forces(const Variant& variant, int trial, double stiffness);

  /// What the stalks of the fruits carried in a trial, in the order of the plant file's fruits.
  std::vector<StalkLoads> stalk_loads(const Variant& variant, int trial);

  /// Numbers that say how a trial begins (MovingStart): 0 for one that begins at rest.
  int start_amplitudes(int trial) const;

  const Experiment& experiment() const;
  const Numerics& numerics() const;
  long simulations() const;               ///< trials simulated so far
  const std::atomic<bool>* stop() const;  ///< the caller's, for others that work for it

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pedicel::discrepancy
