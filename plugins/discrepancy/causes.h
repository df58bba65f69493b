#pragma once

#include <span>
#include <string>
#include <vector>

#include "discrepancy/hypothesis.h"

namespace pedicel::discrepancy {

/// A known effect as a candidate: the values and places from which a fit of it starts. Each start
/// holds the cause's effect alone, to be added to the baseline.
struct Cause {
  std::string name;
  std::vector<Hypothesis> starts;
};

/// Rough sizes of an experiment, from which candidates take their first values.
struct Scales {
  double length = 0.0;          ///< m, of the longest curve
  double mass = 0.0;            ///< kg, of the plant
  double root_stiffness = 0.0;  ///< N m/rad, EI/length at the root
  double curvature = 0.0;       ///< 1/m, the largest that the measured motion needs
  double duration = 0.0;        ///< s, of the longest trial
  double sample_time = 0.0;     ///< s, between samples
};
Scales scales_of(const Experiment& experiment);

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

/// "spring at the root", for sentences.
std::string plain_name(const std::string& cause);
/// Unit of an effect's parameter, "1" where it has none.
std::string unit_of(const std::string& cause, const std::string& parameter);

}  // namespace pedicel::discrepancy
