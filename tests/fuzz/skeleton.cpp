#include "plugins/skeleton/mtg_reader.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto nodes =
      plant::parse_skeleton_csv(fuzz::text_of(data, size), "skeleton.csv", diagnostics);
  fuzz::require_answer(!nodes.empty(), diagnostics);
  if (nodes.empty()) return 0;
  Diagnostics of_plant;
  fuzz::require_answer(plant::checked_skeleton_plant(nodes, "skeleton", {}, of_plant), of_plant);
  return 0;
}
