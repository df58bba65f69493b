#pragma once

#include <span>
#include <string>
#include <vector>

#include "discrepancy/hypothesis.h"
#include "discrepancy/scales.h"

namespace pedicel::discrepancy {

/// A known effect as a candidate: the values and places from which a fit of it starts. Each start
/// holds the cause's effect alone, to be added to the baseline.
struct Cause {
  std::string name;
  std::vector<Hypothesis> starts;
};

/// The parameters that a refit may always change: factors on modulus, density and damping.
Hypothesis baseline();

/// The share of the mesh's error, free (hypothesis.h).
Hypothesis mesh_freedom();

/// A little give at every branch's junction, free up to three quarters of what the plant file's own
/// mesh puts into that joint: what two meshes, or two ways to lead a branch into its stem, differ
/// by. An effect below that is below what the file resolves. Empty where there are no branches.
Hypothesis junction_freedom(const Experiment& experiment);

/// Every known effect that the experiment could show.
std::vector<Cause> candidate_causes(const Experiment& experiment, const Scales& scales);

}  // namespace pedicel::discrepancy
