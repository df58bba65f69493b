#pragma once

#include "plugins/discrepancy/simulate/modes.h"
#include "plugins/discrepancy/simulate/observation.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

/// How a trial that begins in motion is started: what does not depend on the model at hand.
struct StartPlan {
  int modes = 0;        ///< 0: it begins at rest
  double window = 0.0;  ///< s, of the samples that are looked at
  double noise = 0.0;   ///< m, of a sample
  double motion = 0.0;  ///< m, half of the way that markers go

  int amplitudes() const { return 2 * modes; }
};

/// As many modes as the window's samples tell apart with the nominal plant: fewer than a third of
/// the samples, one an axis of a marker, slow enough for the sampling, damped less than critically,
/// and such that each one's amplitude is known better than it is beforehand (likely_amplitude()).
/// Modes of one frequency are taken together. No plan where the trial begins at rest.
StartPlan plan_start(const PlantMaker& maker, const Experiment& experiment, int trial);

/// Of all trials, with the nodes of the plant's file whatever the mesh of a prediction: all meshes
/// are to begin alike. `junction` as in Numerics.
std::vector<StartPlan> plan_starts(const Experiment& experiment, double junction);

/// m, of a mode beforehand: what moves slowly moves far.
double likely_amplitude(const StartPlan& plan, const Modes& modes, int mode);

/// A plant that begins in motion: about its equilibrium, along its first modes, with the speed of
/// what leads it. Amplitudes (m): how far each mode is out, then its speed by its frequency.
class MovingStart {
 public:
  /// `at_rest`: in the equilibrium of time 0. `led`: how its nodes go (m/s and rad/s, rows as in
  /// Modes) because holds and base do.
  MovingStart(const cosserat::RodModel& model, const cosserat::RodState& at_rest, Modes modes,
              Eigen::VectorXd led);

  const Modes& modes() const { return modes_; }
  /// Turned joint by joint, so that a large amplitude does not stretch the plant.
  cosserat::RodState state(const Eigen::VectorXd& amplitudes) const;

 private:
  cosserat::RodState displaced(const Eigen::VectorXd& along) const;

  const cosserat::RodModel* model_;
  cosserat::RodState at_rest_;
  Modes modes_;
  Eigen::VectorXd led_;
};

/// What amplitudes do to the markers at `time` (s): rows by sample, then marker, then axis, W; for
/// small vibrations, without what the instruments do.
Eigen::MatrixXd marker_swings(const cosserat::RodModel& model, const Modes& modes,
                              std::span<const plant::PlacedPoint> markers,
                              std::span<const double> time);

/// The change of amplitudes that explains `residual` (m, NaN where nothing was measured) best, held
/// to what is likely beforehand. `swings` as the instruments see them.
Eigen::VectorXd amplitude_step(const StartPlan& plan, const Modes& modes,
                               const Eigen::MatrixXd& swings, const Eigen::VectorXd& residual,
                               const Eigen::VectorXd& amplitudes);

}  // namespace pedicel::discrepancy
