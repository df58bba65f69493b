#pragma once

#include <span>
#include <string>

#include "plugins/discrepancy/force/force_space.h"

namespace pedicel::discrepancy {

/// What a force did over all fitted trials.
struct ForceCourse {
  double most = 0.0;    ///< N
  double active = 0.0;  ///< share of the time in which it is above a twentieth of `most`
  double work = 0.0;    ///< of its turnover: 1 where it always drives, -1 where it always brakes
};

/// Of an estimated history along the path of its place.
ForceCourse course_of_history(const ForceSpace& space, const ForcePath& path,
                              const Eigen::VectorXd& history);

/// Of the last force of a fitted model, as it acts in a simulation of these trials: its place may
/// lie between markers.
ForceCourse course_of_law(Simulator& simulator, const Hypothesis& model,
                          std::span<const int> trials);

/// When a force of this kind (force_term.h; empty: of no known law) acts, and what it does with
/// energy, as parts of a sentence.
std::string when_it_acts(const ForceCourse& course, const std::string& kind);
std::string what_it_does(const ForceCourse& course);

}  // namespace pedicel::discrepancy
