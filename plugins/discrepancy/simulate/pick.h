#pragma once

#include "pedicel/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// How a pull on a fruit ended, from the force record alone: a stalk that breaks lets go at once,
/// a hand that slides off the fruit gives way over its whole grip.
struct Pick {
  enum class End { detached, slipped, unclear };
  End end = End::unclear;
  double peak_force = 0.0;    ///< N, largest force above the zero
  double peak_time = 0.0;     ///< s
  double time_to_half = 0.0;  ///< s from the peak to half of it; NaN: it never fell that far
};

struct PickSettings {
  double rest = 0.2;        ///< s at the start of the record whose median is the zero
  double slowest = 0.1;     ///< s to half that still count as a break
  double least_peak = 1.0;  ///< N; below it nothing was pulled: unclear
};

/// `force`: time (s) and three components (N) of the holder's force, in any frame that does not
/// turn. Samples with a NaN are passed over. A record without samples is unclear.
Pick judge_pick(const Samples& force, const PickSettings& settings = {});

}  // namespace pedicel::discrepancy
