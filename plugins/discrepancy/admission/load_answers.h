#pragma once

#include <vector>

#include "plugins/discrepancy/admission/following.h"

namespace pedicel::discrepancy {

/// How a marker answers a change of the loads.
struct LoadAnswer {
  double changed = 0.0;  ///< s: when the load changes, as stated
  double seen = 0.0;     ///< s: when the marker leaves its rest, by its own clock
  double with = 0.0;     ///< m: how far it then goes along the change, from rest to rest
  double rise = 0.0;     ///< s, until it has gone half of that
};

/// One for each of the first changes, by their order, where the marker comes to rest before and
/// after each; empty where it never does. `noise` in m.
struct LoadAnswers {
  std::vector<LoadAnswer> all;
  bool complete = false;  ///< one for every change within the record, and no more
};
LoadAnswers load_answers(const Trial& trial, const Track& track, double noise);

}  // namespace pedicel::discrepancy
