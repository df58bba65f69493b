#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/pick/fall.h"
#include "plugins/discrepancy/pick/pick_record.h"

namespace pedicel::discrepancy {

/// How a pull on a fruit ended, from the wrist's force alone. A stalk that breaks lets go at once;
/// a hand that slides off gives way over its whole grip.
struct Pick {
  enum class End {
    came_off,  ///< the load went at once
    slipped,   ///< the load went slowly
    held,      ///< the load did not go
    unclear    ///< the record does not tell; `why` says so
  };
  End end = End::unclear;
  std::string why;  ///< of `unclear`, a clause: "the force stays within its noise"
  std::optional<double> probability;  ///< that it came off; absent where it was held or unclear
  double peak_force = 0.0;            ///< N, largest force above the zero
  double peak_time = 0.0;             ///< s
  double noise = 0.0;                 ///< N, standard deviation of one sample and axis
  double interval = 0.0;              ///< s between samples, median
  double limit = 0.0;        ///< s: half of the load lost within it is as likely a break as not
  std::optional<Fall> fall;  ///< the largest lasting one

  /// Where it came off or began to slip, s.
  std::optional<double> time() const;
  /// "detached", "failed" or "unclear".
  std::string outcome() const;
  /// What happened, in one sentence.
  std::string sentence() const;
};

/// Judges a record. Rows with a missing value are passed over; what cannot be judged is unclear.
/// Throws UsageError for settings out of range.
Pick judge_pick(const PickRecord& record, const PickSettings& settings = {});

/// Probability that the fruit came off, where half of the load went within `half` +- `error` s.
/// `limit` is the time at which it is one half.
double probability_of_break(double half, double error, double limit, double sharpness);

}  // namespace pedicel::discrepancy
