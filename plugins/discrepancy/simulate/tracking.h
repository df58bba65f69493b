#pragma once

#include <vector>

#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/discrepancy/simulate/observation.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

/// Springs from a trial's markers to where they were measured, linear between samples; off where
/// the sample before or the one behind is missing.
class Tracking {
 public:
  /// `stiffness` (N/m) 0: none.
  Tracking(const PlantMaker& maker, const Experiment& experiment, const Trial& trial,
           double stiffness);

  bool active() const { return stiffness_ > 0.0; }
  void add_supports(double t, std::vector<cosserat::Support>& supports) const;
  /// Their pull on the plant at `t` (N, W), three a marker, zero where a spring is off.
  void record(const cosserat::RodModel& model, const cosserat::RodState& state, double t,
              Eigen::Ref<Eigen::RowVectorXd> out) const;

 private:
  /// Where a marker was at `t`; NaN where that is not known.
  Vec3 target(int marker, double t) const;

  const Samples* samples_;
  double stiffness_;
  std::vector<plant::PlacedPoint> places_;
};

}  // namespace pedicel::discrepancy
