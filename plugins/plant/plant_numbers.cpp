#include "pedicel/plant/plant_numbers.h"

#include <algorithm>
#include <iterator>

#include "pedicel/core/check.h"

namespace pedicel::plant {

namespace {

struct Number {
  std::string_view key;
  io::Bounds bounds;
};

constexpr Number numbers[] = {{"material.youngs_modulus", io::positive},
                              {"material.poisson_ratio", {-1.0, 0.5, true}},
                              {"material.density", io::positive},
                              {"material.damping_time", io::not_negative},
                              {"detach.stretch", io::positive},
                              {"detach.bend", io::positive},
                              {"detach.force", io::positive},
                              {"detach.moment", io::positive},
                              {"detach.torsion", io::positive},
                              {"sampling.connect", io::positive},
                              {"sampling.distance", io::positive}};

}  // namespace

io::Bounds number_bounds(std::string_view key) {
  const auto number = std::ranges::find(numbers, key, &Number::key);
  PEDICEL_ASSERT(number != std::end(numbers));
  return number->bounds;
}

}  // namespace pedicel::plant
