#pragma once

#include <string>

namespace pedicel::cosserat {

/// The instruction set that rods are solved with where `asked` is asked for; empty: the best that
/// this processor has. Throws UsageError with those that it has where `asked` is none of them.
std::string checked_instruction_set(const std::string& asked);

/// Solves rods with it from now on; empty: with the best. Throws as above.
void choose_instruction_set(const std::string& asked);

}  // namespace pedicel::cosserat
