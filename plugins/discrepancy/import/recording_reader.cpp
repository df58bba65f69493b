#include "plugins/discrepancy/import/recording_reader.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "engine/io/atomic_file.h"
#include "engine/io/text_file.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::array formats = {&motive_format,     &qualisys_format, &vicon_format,
                                &deeplabcut_format, &c3d_format,      &tracker_format};

const RecordingFormat& format_of(std::string_view bytes, const std::filesystem::path& file,
                                 const std::string& name) {
  const std::string_view head = io::without_mark(bytes.substr(0, format_head));
  for (const RecordingFormat* format : formats)
    if (name.empty() ? format->is_kind(head) : name == format->name) return *format;
  throw InvalidFile({file.string(), 1, 1},
                    "the format cannot be told from the content, expected --format with one of: " +
                        recording_format_names());
}

void check_names(const Recording& recording, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const std::string& name : recording.names)
    if (!names.insert(name).second)
      diagnostics.error({recording.file.string()},
                        "point " + in_quotes(name) + " appears twice, expected each name once");
  if (recording.names.empty())
    diagnostics.error({recording.file.string()}, "no points, expected at least one");
  else if (recording.samples() == 0)
    diagnostics.error({recording.file.string()}, "no samples, expected at least one");
}

void check_increases(const Recording& recording, Diagnostics& diagnostics) {
  for (const auto& [count, what] :
       {std::pair{&recording.time, "time"}, std::pair{&recording.frame, "frame"}})
    for (std::size_t i = 1; i < count->size(); ++i)
      if (!((*count)[i] > (*count)[i - 1])) {
        diagnostics.error({recording.file.string()},
                          std::string("the ") + what + " of sample " + std::to_string(i + 1) +
                              " does not increase, expected one recording in time");
        break;
      }
}

}  // namespace

int Recording::index_of(const std::string& name) const {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

std::string recording_format_names() {
  std::string list;
  for (const RecordingFormat* format : formats)
    list += std::string(list.empty() ? "" : ", ") + format->name;
  return list;
}

std::optional<Recording> read_recording(std::string bytes, const std::filesystem::path& file,
                                        const std::string& name, const RecordingOptions& options,
                                        Diagnostics& diagnostics) {
  const int before = diagnostics.error_count();
  // A text in UTF-16 is told from its content once it is UTF-8.
  const bool is_text = name.empty() ? !c3d_format.is_kind(bytes) : name != c3d_format.name;
  if (is_text)
    bytes = io::text_of_bytes(std::move(bytes), file.string(), io::CaptureExports::taken);
  const RecordingFormat& format = format_of(bytes, file, name);
  if (format.otherwise != nullptr && !format.is_kind(bytes)) {
    diagnostics.error({file.string(), 1, 1},
                      std::string(format.otherwise) + ", expected an export as " + format.program);
    return std::nullopt;
  }
  Recording recording = format.read({bytes, file, options, diagnostics});
  recording.file = file;
  recording.program = format.program;
  if (diagnostics.error_count() == before) check_names(recording, diagnostics);
  if (diagnostics.error_count() == before) check_increases(recording, diagnostics);
  if (diagnostics.error_count() > before) return std::nullopt;
  return recording;
}

std::optional<Recording> read_recording(const std::filesystem::path& file,
                                        const std::string& format, const RecordingOptions& options,
                                        Diagnostics& diagnostics) {
  return read_recording(io::read_file(file), file, format, options, diagnostics);
}

}  // namespace pedicel::discrepancy
