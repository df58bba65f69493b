#include "engine/io/yaml.h"
#include "engine/world/scene_reader.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto scene =
      world::parse_scene(fuzz::text_of(data, size), "/dev/shm/fuzz.scene.yaml", diagnostics);
  fuzz::require_answer(scene, diagnostics);
  // What was kept for others to read is read as it stood.
  for (const io::YamlPiece& piece : scene ? scene->effects : std::vector<io::YamlPiece>{})
    if (io::read_piece(piece, diagnostics).raw().IsDefined()) io::piece_text(piece);
  return 0;
}
