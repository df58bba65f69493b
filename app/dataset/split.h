#pragma once

#include <cstdint>
#include <string_view>

namespace pedicel::app {

/// Which part of a data set a picture belongs to: of every ten pictures in a row eight train, one
/// validates and one tests, drawn from the seed. It does not depend on how many there are.
std::string_view split_of(long picture, std::uint64_t seed);

}  // namespace pedicel::app
