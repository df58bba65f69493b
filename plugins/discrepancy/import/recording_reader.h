#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "plugins/discrepancy/import/recording.h"

namespace pedicel::discrepancy {

/// The bytes of a file, and where its faults go.
struct RecordingSource {
  std::string_view bytes;  ///< text in UTF-8, but for formats that are none
  std::filesystem::path file;
  RecordingOptions options;
  Diagnostics& diagnostics;
};

/// A kind of file with points over time.
struct RecordingFormat {
  const char* name;     ///< of `--format`
  const char* program;  ///< "OptiTrack Motive CSV"
  bool is_text;
  /// Whether a file that begins so is of this kind.
  bool (*is_kind)(std::string_view bytes);
  /// Adds an error to the diagnostics where the file cannot be read.
  Recording (*read)(const RecordingSource& source);
  const char* otherwise = nullptr;  ///< said of a file that is not of this kind; none: by read()
};

/// read() of a class that does it.
template <class Reader>
Recording read_with(const RecordingSource& source) {
  return Reader(source).read();
}

/// Bytes that is_kind() looks at, at most.
constexpr std::size_t format_head = 4096;

extern const RecordingFormat motive_format, qualisys_format, vicon_format, deeplabcut_format,
    tracker_format, c3d_format;

/// "motive, qualisys, ...".
std::string recording_format_names();

/// Reads a recording. `format` is one of recording_format_names(), or empty: then it is told from
/// the content. Every fault goes to the diagnostics with file, line and column; nothing comes back
/// where there is one. Throws InvalidFile where the file cannot be read as a whole.
std::optional<Recording> read_recording(const std::filesystem::path& file,
                                        const std::string& format, const RecordingOptions& options,
                                        Diagnostics& diagnostics);

/// The same of bytes that are there already.
std::optional<Recording> read_recording(std::string bytes, const std::filesystem::path& file,
                                        const std::string& format, const RecordingOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
