#include "engine/io/file_magic.h"

#include <algorithm>
#include <array>

namespace pedicel::io {

namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  const char* kind;
};

constexpr const char* unpack = "expected the text in it: unpack it first";
constexpr const char* save_as_csv =
    "expected a text: open it in the program that made it and save it as \"CSV UTF-8\"";

constexpr std::array packed = {Magic{"\x1F\x8B"sv, "compressed with gzip"},
                               Magic{"BZh"sv, "compressed with bzip2"},
                               Magic{"\xFD"
                                     "7zXZ\0"sv,
                                     "compressed with xz"},
                               Magic{"\x28\xB5\x2F\xFD"sv, "compressed with zstd"},
                               Magic{"7z\xBC\xAF\x27\x1C"sv, "a 7z archive"},
                               Magic{"Rar!\x1A\x07"sv, "a RAR archive"}};

constexpr std::array others = {Magic{"%PDF-"sv, "a PDF document"},
                               Magic{"\x89PNG\r\n"sv, "a PNG image"},
                               Magic{"\xFF\xD8\xFF"sv, "a JPEG image"},
                               Magic{"\x89HDF\r\n"sv, "an HDF5 file (MATLAB 7.3, h5)"},
                               Magic{"MATLAB 5.0 MAT-file"sv, "a MATLAB file (.mat)"},
                               Magic{"\x93NUMPY"sv, "a NumPy array (.npy)"},
                               Magic{"SQLite format 3\0"sv, "an SQLite database"},
                               Magic{"PAR1"sv, "a Parquet table"},
                               Magic{"ARROW1"sv, "an Arrow table"},
                               Magic{"\x7F"
                                     "ELF"sv,
                                     "a program"},
                               Magic{"RIFF"sv, "a RIFF file (sound or film)"},
                               Magic{"{\\rtf"sv, "an RTF document"}};

// Tables of motion capture, which have several lines of names in place of one. Told by how the
// first of them begins; what comes behind the word.
struct Export {
  std::string_view begins;
  std::string_view then;
  const char* program;
  bool imported;  // by `pedicel import`
};
constexpr std::array exports = {Export{"Trajectories", "\r\n,;", "Vicon Nexus", true},
                                Export{"Format Version", ",;\t", "OptiTrack Motive", true},
                                Export{"NO_OF_FRAMES", "\t,;", "Qualisys Track Manager", true},
                                Export{"FILE_VERSION", "\t,;", "Qualisys Track Manager", true},
                                Export{"PathFileType", "\t,; ", "OpenSim (.trc)", false},
                                Export{"scorer", ",;\t", "DeepLabCut", true}};

// A column may be called PAR1: then no byte is one that no text has.
bool has_control(std::string_view bytes) {
  bytes = bytes.substr(0, 4096);
  return std::any_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c < 0x09; });
}

bool is_printable(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](unsigned char c) { return c >= 0x20 && c < 0x7F; });
}

bool matches(std::string_view bytes, const Magic& magic) {
  return bytes.starts_with(magic.bytes) && (!is_printable(magic.bytes) || magic.bytes[0] == '%' ||
                                            magic.bytes[0] == '{' || has_control(bytes));
}

bool contains(std::string_view bytes, std::string_view part) {
  return bytes.find(part) != std::string_view::npos;
}

std::string zip_kind(std::string_view bytes) {
  if (contains(bytes, "opendocument.spreadsheet")) return "a workbook (.ods), ";
  if (contains(bytes, "xl/workbook") || contains(bytes, "xl/worksheets") ||
      contains(bytes, "[Content_Types].xml"))
    return "an Excel workbook (.xlsx), ";
  return {};
}

// Text without a byte order mark that is UTF-16 all the same: every second byte is 0.
bool is_bare_utf16(std::string_view bytes) {
  const std::size_t pairs = std::min<std::size_t>(bytes.size() / 2, 64);
  if (pairs < 2) return false;
  std::size_t even = 0, odd = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    even += bytes[2 * i] == '\0';
    odd += bytes[2 * i + 1] == '\0';
  }
  return (even == 0 && odd * 2 > pairs) || (odd == 0 && even * 2 > pairs);
}

bool begins_without_case(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), text.begin(), [](char a, char b) {
           return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
         });
}

}  // namespace

std::string kind_of_export(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  for (const Export& known : exports)
    if (text.size() > known.begins.size() && text.starts_with(known.begins) &&
        known.then.find(text[known.begins.size()]) != std::string_view::npos)
      return std::string("a table as ") + known.program +
             " writes it, with several lines of names, expected one: time,m1.x,m1.y,m1.z,... in "
             "seconds since the trial began and metres" +
             (known.imported ? "; pedicel import makes an experiment of it" : "");
  return {};
}

std::string kind_of_bytes(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04"sv)) {
    const std::string kind = zip_kind(bytes);
    return kind.empty() ? std::string("a zip archive, ") + unpack : kind + save_as_csv;
  }
  if (bytes.starts_with("\xD0\xCF\x11\xE0"sv))
    return std::string("an old Office file (.xls, .doc), ") + save_as_csv;
  for (const Magic& magic : packed)
    if (matches(bytes, magic)) return std::string(magic.kind) + ", " + unpack;
  for (const Magic& magic : others)
    if (matches(bytes, magic)) return std::string(magic.kind) + ", expected a text file";
  if (bytes.starts_with("version https://git-lfs"))
    return "a Git LFS pointer, expected the file itself: run git lfs pull";
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  const std::string_view text = bytes.substr(first);
  if (begins_without_case(text, "<!doctype html") || begins_without_case(text, "<html"))
    return "a web page, expected the file itself: download it as raw text";
  if (is_bare_utf16(bytes))
    return "UTF-16 without a byte order mark, expected UTF-8: save it as UTF-8";
  return {};
}

}  // namespace pedicel::io
