#pragma once

#include <optional>
#include <string>

#include "engine/core/frames.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy::testing {

/// A recording, or what was said of it.
struct Reading {
  std::optional<Recording> recording;
  std::string faults;
  const Recording& operator*() const { return recording.value(); }
};

inline Reading read(const std::string& bytes, const std::string& format = "") {
  Reading reading;
  Diagnostics diagnostics;
  try {
    reading.recording = read_recording(bytes, "f.csv", format, {}, diagnostics);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
  }
  reading.faults = diagnostics.text();
  return reading;
}

inline Vec3 point(const Recording& recording, int sample, int index) {
  return recording.value.block<1, 3>(sample, 3 * index).transpose();
}

}  // namespace pedicel::discrepancy::testing
