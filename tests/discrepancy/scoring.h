#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/select/verdict.h"
#include "tests/discrepancy/cause_size.h"
#include "tests/discrepancy/hidden_case.h"

namespace pedicel::hidden {

/// What a verdict was worth.
enum class Call {
  right,            ///< quiet, all names and no other, a set with the truth, unknown: as expected
  partial,          ///< one of two names, and no wrong one
  wrong,            ///< a wrong name with confidence
  sure,             ///< the truth alone, where the data cannot tell it from another cause
  held,             ///< "cannot tell", and the truth is in the set
  not_held,         ///< "cannot tell", and it is not
  unknown,          ///< nothing known fits, though it was known
  missed,           ///< nothing is wrong, or no more than the modulus and damping that were off
  parameter_alarm,  ///< one of the three parameters was named in null data
  false_alarm,      ///< anything else was said of null data
  refused           ///< data or numerics were said to be too bad
};
const char* name_of(Call call);

/// What the true model leaves on the trials kept back: the noise alone, in the units of
/// Verdict::check.
struct TrueError {
  double error = 1.0;  ///< RMS residual over the noise floor
  int samples = 0;     ///< 0: no trial was kept back
};

/// One verdict against one truth.
struct Score {
  int number = 0;
  std::uint64_t seed = 0;
  std::string kind, plant, pack, outcome;
  bool coloured = false, off = false;
  double times = 0.0;  ///< the smallest identifiable size
  /// That size tells it from every other cause, too; false: it is seen, no more (older lines).
  bool told_apart = false;
  std::vector<std::string> hidden, said;
  /// The names of the registry for what was hidden; modulus and damping where they were off as
  /// well; and what the verdict tells as a detail.
  std::vector<std::string> causes, off_too, details;
  Call call = Call::missed;
  /// Share of the true model's gain on trials kept back; absent where the true model gains less
  /// than 10 noise units there, or nothing was named.
  std::optional<double> gain_share;
  std::vector<SizeError> sizes;  ///< of the causes that were named rightly
  double evidence = 0.0;         ///< of the first cause, nats
  /// Of one hidden effect: nats by which the data, whatever numbers cost, say less for the nearest
  /// other cause than for the true one, both refitted in full; absent where one of them was not.
  std::optional<double> lead;
  /// What was said of a force from outside the list, where the verdict is unknown; else empty.
  std::string force_kind;
  /// How far from the hidden one, as a share of their curve; absent on another curve.
  std::optional<double> force_away;
  /// The deviation that its place was said with, as a share of the curve; absent where there is
  /// none.
  std::optional<double> force_error;
  bool force_elsewhere = false;          ///< the hidden one's curve is said to do as well
  std::vector<std::string> other_kinds;  ///< that the data are said not to tell from `force_kind`
  double alarm = 0.0;                    ///< largest directed statistic less its level
  long simulations = 0;
  double seconds = 0.0;
  std::string fault;  ///< why there is no verdict; empty: there is one
};

/// Whether known effects were named, all that was off with them, and nothing else. What is told as
/// a detail may be among it, and is no name of its own.
bool named_exactly(const Score& score);

/// Scores `verdict` of the case `hidden`.
Score score(const HiddenCase& hidden, const discrepancy::Verdict& verdict, const TrueError& truth);

/// A case whose diagnosis ended with an exception.
Score failed_score(const HiddenCase& hidden, const std::string& fault);

/// One line of JSON, and back. Reading throws std::exception where a line is not a score.
std::string to_line(const Score& score);
Score from_line(const std::string& line);

}  // namespace pedicel::hidden
