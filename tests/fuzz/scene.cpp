#include "pedicel/world/scene_reader.h"
#include "reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto scene =
      world::parse_scene(fuzz::text_of(data, size), "/dev/shm/fuzz.scene.yaml", diagnostics);
  fuzz::require_answer(scene, diagnostics);
  return 0;
}
