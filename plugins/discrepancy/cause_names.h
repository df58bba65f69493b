#pragma once

#include <string>
#include <utility>
#include <vector>

#include "discrepancy/hypothesis.h"

namespace pedicel::discrepancy {

/// "spring at the root", for sentences.
std::string plain_name(const std::string& cause);

/// Unit of an effect's parameter, "1" where it has none.
std::string unit_of(const std::string& cause, const std::string& parameter);

/// Whether a cause's parameter says when something happens, or how much later (s).
bool is_moment(const std::string& cause, const std::string& parameter);

/// The value of a cause's parameter at which the cause vanishes.
Vanishes vanishing(const std::string& cause, const std::string& parameter);

/// Pairs of causes, of which the second has the first as a special case: a wind of no speed is
/// drag.
const std::vector<std::pair<std::string, std::string>>& special_cases();

/// A bound of a cause's number at which it is, or goes over into, another cause: relaxation with a
/// time longer than the longest trial is creep, a weak stretch of no length is a hinge.
struct Limit {
  std::string cause, parameter;
  bool high = false;  ///< the upper bound; else the lower one
  std::string becomes;
};
const std::vector<Limit>& limits();

/// Whether two causes are of one kind (memory and damping, masses, softness, air, grip, frame):
/// where one of them acts, another law of the same kind takes up what two honest implementations of
/// the first differ by.
bool same_family(const std::string& a, const std::string& b);

}  // namespace pedicel::discrepancy
