#include "plugins/discrepancy/import/force_record.h"
#include "plugins/discrepancy/import/recording_reader.h"
#include "plugins/discrepancy/import/world_frame.h"
#include "plugins/discrepancy/import/world_tracks.h"
#include "tests/fuzz/reading.h"

using namespace pedicel;

namespace {

discrepancy::Statements everything() {
  discrepancy::Statements said;
  said.unit = 0.001;
  said.rate = 100.0;
  said.axes = discrepancy::turn_of_up('y');
  said.scale = 0.001;
  said.origin_pixel = Eigen::Vector2d(10, 20);
  return said;
}

void read_points(const std::string& text, const std::string& format) {
  Diagnostics diagnostics;
  try {
    const auto found = discrepancy::read_recording(text, "f.csv", format, {}, diagnostics);
    fuzz::require_answer(found, diagnostics);
    if (!found) return;
    fuzz::require(found->value.cols() == static_cast<Eigen::Index>(3 * found->names.size()),
                  "three columns a point");
    fuzz::require(!found->value.array().isInf().any(), "no infinite place");
    discrepancy::ImportNotes notes;
    const auto tracks = discrepancy::world_tracks(*found, everything(), notes);
    fuzz::require(tracks.time.size() == static_cast<std::size_t>(found->samples()),
                  "a time a sample");
    fuzz::require(notes.missing.empty(), "nothing lacks where everything is said");
  } catch (const InvalidFile&) {
  }
}

void read_forces(const fuzz::Folder& folder, const std::string& text) {
  discrepancy::ForceStatements said;
  said.direction = Vec3::UnitX();
  said.axes = Mat3::Identity();
  said.unit = said.time_unit = 1.0;
  Diagnostics diagnostics;
  discrepancy::ImportNotes notes;
  try {
    const auto record =
        discrepancy::read_force_record(folder.write("force.csv", text), said, diagnostics, notes);
    if (diagnostics.has_errors() || !notes.missing.empty()) return;
    fuzz::require(static_cast<std::size_t>(record.value.rows()) == record.time.size(),
                  "a force a time");
  } catch (const InvalidFile&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  const std::string text = fuzz::text_of(data, size);
  for (const char* format : {"", "motive", "qualisys", "vicon", "deeplabcut", "tracker"})
    read_points(text, format);
  read_forces(folder, text);
  return 0;
}
