#pragma once

#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/fit/fit.h"
#include "plugins/discrepancy/simulate/hypothesis.h"
#include "plugins/discrepancy/simulate/scales.h"

namespace pedicel::discrepancy {

/// A known effect as a candidate: the values and places from which a fit of it starts. Each start
/// holds the cause's effect alone, to be added to the baseline.
struct Cause {
  std::string name;
  std::vector<Hypothesis> starts;
  /// Further starts, with sizes from symptoms of the data; empty where none gives one.
  std::vector<Hypothesis> led = {};
  /// How clearly symptoms speak for it: the largest of their deviations over their ranks. 0: none
  /// does.
  double spoken_for = 0.0;
};

/// What an experiment is, as far as first values of effects depend on it.
effects::StartContext start_context(const Experiment& experiment, const Scales& scales);

/// The parameters that a refit may always change: factors on modulus, density and damping.
Hypothesis baseline();

/// The share of the mesh's error, free (hypothesis.h).
Hypothesis mesh_nuisance();

/// A little give at every branch's junction, for what two ways to lead a branch into its stem
/// differ by. Empty where there are no branches.
Hypothesis junction_nuisance(const Experiment& experiment, const Evidence& evidence);

/// Whether what such junctions give, the last `count` numbers of a model that was fitted with them,
/// may come from another solver's way: the same share of the branch's own first segment at all of
/// them, and no more than a mesh of half the plant file's spacing makes of it. Softer joints, or
/// one of several, are a finding.
bool is_discretisation(const FitSummary& model, int count, const Evidence& evidence);

/// Every known effect that the experiment could show.
std::vector<Cause> candidate_causes(const Experiment& experiment, const Scales& scales);
/// Those and the effects that no diagnosis tries by itself.
std::vector<Cause> fitted_causes(const Experiment& experiment, const Scales& scales);

}  // namespace pedicel::discrepancy
