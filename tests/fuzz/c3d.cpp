#include "plugins/discrepancy/import/recording_reader.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto found =
      discrepancy::read_recording(fuzz::text_of(data, size), "f.c3d", "c3d", {}, diagnostics);
  fuzz::require_answer(found, diagnostics);
  if (!found) return 0;
  fuzz::require(found->value.cols() == static_cast<Eigen::Index>(3 * found->names.size()),
                "three columns a point");
  fuzz::require(!found->value.array().isInf().any(), "no infinite place");
  return 0;
}
