#include "plugins/simulation/large_plant.h"

#include "engine/core/verbosity.h"

namespace pedicel::simulation {

void say_if_large(const plant::PlantFile& file) {
  constexpr std::size_t large = 30'000;  // points: some seconds
  std::size_t points = 0;
  for (const plant::PlantCurve& curve : file.curves) points += curve.points.size();
  if (points > large)
    say(Verbosity::lines, "%s: %zu points in %zu curves, building it takes a while",
        file.name.c_str(), points, file.curves.size());
}

}  // namespace pedicel::simulation
