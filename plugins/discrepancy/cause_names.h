#pragma once

#include <string>

#include "discrepancy/hypothesis.h"

namespace pedicel::discrepancy {

/// "spring at the root", for sentences.
std::string plain_name(const std::string& cause);

/// Unit of an effect's parameter, "1" where it has none.
std::string unit_of(const std::string& cause, const std::string& parameter);

/// The value of a cause's parameter at which the cause vanishes.
Vanishes vanishing(const std::string& cause, const std::string& parameter);

/// Whether two causes are of one kind (memory and damping, masses, softness, air, grip, frame):
/// where one of them acts, another law of the same kind takes up what two honest implementations of
/// the first differ by.
bool same_family(const std::string& a, const std::string& b);

}  // namespace pedicel::discrepancy
