#pragma once

#include <optional>

#include "plugins/discrepancy/pick/pick_force.h"

namespace pedicel::discrepancy {

/// How a pull on a fruit is judged. The first three are of the arm and its sensor.
struct PickSettings {
  double rest = 0.2;  ///< s at the start of the record whose median is the zero
  /// s; half of the load lost within it is a break. The arm and the gripper swing freely after a
  /// break, in these picks at 10 Hz; what is let go within half a period is let go suddenly, and
  /// half of that is a quarter of a period.
  double response = 0.025;
  double sharpness = 3.0;  ///< of the odds: (response / time to half) to this power
  double level = 0.15;     ///< s, over which a level before and after a fall is taken
  double settle = 0.05;    ///< s between the two: the fall itself
  double share = 0.5;      ///< of the load that must be gone, and stay away, where it was let go
};

/// Checks ranges: the text names field, value and bound; empty where all is well.
std::string check(const PickSettings& settings);

/// The largest level of the load in a record.
struct LargestLoad {
  double time = 0.0;     ///< s
  double force = 0.0;    ///< N, mean over the time of a level
  Eigen::VectorXd pull;  ///< unit, along it
};
/// For records of three samples or more.
LargestLoad largest_load(const PickForce& course, const PickSettings& settings);

/// A lasting fall of the load in a record.
struct Fall {
  double time = 0.0;    ///< s, about where
  double before = 0.0;  ///< N, largest level before it, along the pull
  double after = 0.0;   ///< N, level after it, along the same line
  double share = 0.0;   ///< (before - after) / before
  /// s, shortest in which half of what was lost went; absent where it took longer than the levels.
  std::optional<double> half;
  double half_error = 0.0;   ///< s, standard
  double onset = 0.0;        ///< s, where the steepest part begins
  double onset_error = 0.0;  ///< s, standard
  double smoothing = 0.0;    ///< s, over which samples were averaged against the noise
  Eigen::VectorXd pull;      ///< unit, along the load before it
};

/// The largest one within the time of two levels. Nothing where the record is too short for a level
/// before and after.
std::optional<Fall> find_fall(const PickForce& course, const PickSettings& settings);

/// From the largest load to what is left at the end of the record, however long that took: without
/// a time to half.
Fall whole_fall(const PickForce& course, const LargestLoad& load, const PickSettings& settings);

/// Where a slow fall begins, s, with a standard error: the straight line through its first half, a
/// tenth to a half of what is lost.
struct Beginning {
  double time = 0.0, error = 0.0;
};
Beginning beginning_of(const PickForce& course, const Fall& fall, const PickSettings& settings);

/// Whether most of the largest load goes at the very end, with no time left to see that it stays
/// away.
bool ends_in_a_fall(const PickForce& course, const LargestLoad& load, const PickSettings& settings);

}  // namespace pedicel::discrepancy
