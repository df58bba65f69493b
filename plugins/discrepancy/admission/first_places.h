#pragma once

#include <vector>

#include "plugins/discrepancy/admission/contradiction_checks.h"

namespace pedicel::discrepancy {

/// Where the markers of a trial were first seen, and where the nominal plant has them then:
/// standing on a base that may have moved before. Markers that were never seen are left out.
struct FirstPlaces {
  std::vector<int> marker;    ///< index into the experiment's
  std::vector<Vec3> seen;     ///< m, W
  std::vector<Vec3> drawn;    ///< m, W
  std::vector<Vec3> settled;  ///< m, W
  Vec3 root = Vec3::Zero();   ///< m, W

  int size() const { return static_cast<int>(marker.size()); }
  double spread() const;  ///< m, rms distance of the drawn places from the root
};
FirstPlaces first_places(const TrialView& view);

/// m, rms; of points of equal number.
double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

double median_of(std::vector<double> values);  ///< NaN where there is none

}  // namespace pedicel::discrepancy
