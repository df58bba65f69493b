#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/force/force_space.h"

namespace pedicel::discrepancy {

/// A law of the library (force_term.h) with the numbers that explain most in its place.
struct ForceTerm {
  plant::Effect force;
  double gain = 0.0;      ///< log-likelihood above that of no force, by linear response
  int parameters = 0;     ///< that were chosen for it, those of its shape included
  double evidence = 0.0;  ///< gain less what they cost (Bayesian information criterion)
};

struct LibraryScales {
  double length = 0.0;      ///< m, of the longest curve
  double duration = 0.0;    ///< s, of the longest trial
  double dispersion = 1.0;  ///< by which gains are divided: more than noise may be left
  int samples = 0;
  std::size_t choices = 1;          ///< places and laws that are tried in all
  std::vector<std::string> trials;  ///< names, by experiment
};

/// The best term of every kind of law at a place, largest evidence first: a law's force along the
/// path is a history, whose gain follows from the normal equations without any simulation. Numbers
/// that the force is not linear in are looked for on a grid and then by a pattern search.
std::vector<ForceTerm> regress_force(const ForceSpace& space, const ForcePath& path,
                                     const LibraryScales& scales);

/// Coefficients of a force along a path.
Eigen::VectorXd history_of(const plant::Effect& force, const ForceSpace& space,
                           const ForcePath& path, const LibraryScales& scales);

}  // namespace pedicel::discrepancy
