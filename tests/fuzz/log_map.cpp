#include "plugins/discrepancy/log_import/log_map.h"

#include "tests/fuzz/reading.h"

using namespace pedicel;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Diagnostics diagnostics;
  const auto map = discrepancy::parse_log_map(fuzz::text_of(data, size), "f.yaml", diagnostics);
  fuzz::require_answer(map, diagnostics);
  return 0;
}
