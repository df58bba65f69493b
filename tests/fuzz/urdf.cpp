#include "engine/urdf/urdf_reader.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto robot = robot::parse_urdf(fuzz::text_of(data, size), "/dev/shm/fuzz.urdf",
                                       robot::PackagePaths{}, diagnostics);
  fuzz::require_answer(robot, diagnostics);
  return 0;
}
