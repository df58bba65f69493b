#include "plugins/plant/plant_builder.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

/// Small ones are built, too: a build takes milliseconds.
bool is_small(const plant::PlantFile& file) {
  constexpr double most_elements = 40.0;
  double elements = 0.0;
  for (const plant::PlantCurve& curve : file.curves)
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      elements += 1.0 + (curve.points[i] - curve.points[i - 1]).norm() / file.distance;
  return elements <= most_elements && file.connect > 0.01 * file.distance;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto file = plant::parse_plant(fuzz::text_of(data, size), "plant.yaml", diagnostics);
  fuzz::require_answer(file, diagnostics);
  if (!file) return 0;

  Diagnostics again;
  const auto written = plant::parse_plant(plant::plant_text(*file), "written", again);
  fuzz::require(written && *written == *file, "a plant that is written reads back as the same");

  if (!is_small(*file)) return 0;
  Diagnostics of_build;
  fuzz::require_answer(plant::build_plant(*file, {}, of_build), of_build);
  return 0;
}
