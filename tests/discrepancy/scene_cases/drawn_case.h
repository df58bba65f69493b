#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/discrepancy/scene_cases/scene_case.h"

/// The cases of the scene bench: what each hides, and sizes that a seed draws.
namespace pedicel::scene_case {

/// What a case is about.
struct Order {
  int number = 0;
  std::string kind;                ///< null, effect, pair, outside
  std::vector<std::string> names;  ///< effects, or "post", or "string"
  bool off = false;                ///< the file's modulus is wrong, too
  /// What is recorded beside markers and wrench, and of what.
  bool commands = false, torques = false, harvest = false;
};

/// The hundred cases, of which any first few have a share of each kind and name, and behind them
/// those of other records and of effects that came later.
std::vector<Order> orders();

/// A setting with all of an order's things hidden, each at a size that `seed` draws.
Setting drawn(const Order& order, std::uint64_t seed);

/// Names of all that is hidden, modulus included, sorted.
std::vector<std::string> hidden_names(const Setting& setting);

}  // namespace pedicel::scene_case
