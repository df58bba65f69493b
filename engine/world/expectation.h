#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/diagnostics.h"

namespace pedicel::world {

/// A number that a run is judged by. `subjects` names the keys that say of what it is measured; the
/// ones in brackets may be left out (then: of all).
struct MeasuredQuantity {
  std::string_view name;  ///< with its unit, as log columns
  std::string_view subjects;
  std::string_view sentence;
};

/// Every quantity that a scene may expect something of.
std::span<const MeasuredQuantity> known_quantities();

/// A pass criterion: a quantity and a bound, or how it changes over a sweep.
struct Expectation {
  enum class Test {
    is,
    between,
    above,
    below,
    rises_with_sweep,
    falls_with_sweep,
    steady_over_sweep,  ///< all values within `low` of their mean, relative
  };
  std::string quantity;
  std::string fruit, body, plant, link;  ///< of what; empty: of all
  Test test = Test::is;
  double low = 0.0, high = 0.0;  ///< between; the others use `low`
  SourcePosition where;

  bool over_sweep() const { return test >= Test::rises_with_sweep; }
};

/// "detach_time_s of truss/fruit_3 between 1 and 3"
std::string to_string(const Expectation& expectation);

struct ExpectationResult {
  Expectation expectation;
  std::vector<double> measured;  ///< one value; one a value of the sweep where over_sweep()
  bool met = false;
};

/// A value that could not be measured (a fruit that never came off) is NaN and meets nothing.
ExpectationResult judge(const Expectation& expectation, double measured);

/// The values in the order of the sweep, two at least; they must rise (fall) strictly, or be
/// steady.
ExpectationResult judge_sweep(const Expectation& expectation, std::span<const double> measured);

/// "met     detached_count is 1: 1"
std::string to_string(const ExpectationResult& verdict);

}  // namespace pedicel::world
