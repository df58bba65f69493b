#include <cmath>

#include "plugins/discrepancy/pick/pick_labels.h"
#include "plugins/discrepancy/pick/pick_text.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

void judge(const std::filesystem::path& file) {
  discrepancy::PickColumns said;
  said.time_unit = said.force_unit = 1.0;
  Diagnostics diagnostics;
  discrepancy::ImportNotes notes;
  try {
    discrepancy::JudgedPick judged;
    judged.record = discrepancy::read_pick_record(file, said, diagnostics, notes);
    if (diagnostics.has_errors() || !notes.missing.empty()) return;
    fuzz::require(static_cast<std::size_t>(judged.record.force.rows()) == judged.record.time.size(),
                  "a force a time");
    judged.pick = discrepancy::judge_pick(judged.record);
    const auto& probability = judged.pick.probability;
    fuzz::require(!probability || (*probability >= 0.0 && *probability <= 1.0), "a probability");
    fuzz::require(!discrepancy::to_text(judged).empty() && !discrepancy::to_json({judged}).empty(),
                  "an answer");
  } catch (const InvalidFile&) {
  }
}

void read_labels(const std::filesystem::path& file) {
  Diagnostics diagnostics;
  try {
    discrepancy::read_pick_labels(file, diagnostics);
  } catch (const InvalidFile&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::filesystem::path file = folder.write("pick.csv", fuzz::text_of(data, size));
  judge(file);
  read_labels(file);
  return 0;
}
