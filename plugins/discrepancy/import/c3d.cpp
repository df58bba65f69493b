// C3D (c3d.org): a head of 512 bytes, a section of parameters in groups, and frames. A frame has x,
// y, z and a fourth number of every point, negative where it was not seen, then the analog samples.
// All numbers are integers with one scale, or all are reals.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/io/csv.h"
#include "engine/io/table_text.h"
#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/c3d_parameters.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t block = 512;  // bytes
constexpr std::size_t most_points = 65535;

/// The number of the block of parameters, then 0x50; no text has a byte 0.
bool is_c3d(std::string_view head) {
  return head.size() >= 2 && head[0] != '\0' && head[1] == '\x50' &&
         head.substr(0, block).find('\0') != std::string_view::npos;
}

/// Places of the head's numbers, in bytes.
struct C3dHead {
  static constexpr std::size_t points = 2, analog = 4, first = 6, last = 8, scale = 12, data = 16,
                               rate = 20;
};

class C3dReader {
 public:
  C3dReader(const RecordingSource& source, C3dProcessor processor, std::size_t parameters)
      : bytes_(source.bytes, processor),
        file_(source.file.string()),
        diagnostics_(source.diagnostics),
        before_(diagnostics_.error_count()),
        parameters_(bytes_, parameters, file_, diagnostics_) {}

  Recording read() {
    if (diagnostics_.error_count() > before_) return {};
    points_ = parameters_.whole("POINT", "USED").value_or(bytes_.word(C3dHead::points));
    analog_ = bytes_.word(C3dHead::analog);
    if (const auto scale = parameters_.number("POINT", "SCALE")) scale_ = *scale;
    if (!std::isfinite(scale_) || scale_ == 0.0)
      return fail("the scale of the points is " + io::format_number(scale_) +
                  ", expected a finite number that is not 0");
    if (points_ == 0 || points_ > most_points)
      return fail("the head counts " + std::to_string(points_) + " points, expected 1 to " +
                  std::to_string(most_points));
    read_statements();
    read_names();
    read_frames();
    return std::move(recording_);
  }

 private:
  Recording fail(const std::string& what) {
    diagnostics_.error({file_}, what);
    return {};
  }

  void read_statements() {
    double rate = parameters_.number("POINT", "RATE").value_or(bytes_.real(C3dHead::rate));
    if (std::isfinite(rate) && rate > 0.0) recording_.rate = {rate, {file_}};
    const auto units = parameters_.texts("POINT", "UNITS");
    if (!units.empty() && !units.front().empty()) take_unit(units.front());
    // The axis that goes up on a screen; one that goes down is for the person to turn.
    const auto up = parameters_.texts("POINT", "Y_SCREEN");
    if (!up.empty() && up.front().size() == 2 && up.front()[0] == '+') {
      const char axis = static_cast<char>(up.front()[1] | 0x20);
      if (axis >= 'x' && axis <= 'z') recording_.up = {axis, {file_}};
    }
  }

  void take_unit(const std::string& text) {
    const auto unit = io::unit_of(text);
    if (unit && unit->quantity == io::Quantity::length)
      recording_.unit = {unit->factor, {file_}};
    else
      recording_.remarks.push_back("POINT:UNITS is " + in_quotes(text) + ", which is no length");
  }

  // More than 255 labels go on in LABELS2, LABELS3, ...
  void read_names() {
    auto& names = recording_.names;
    for (int part = 1; names.size() < points_; ++part) {
      const auto more = parameters_.texts(
          "POINT", part == 1 ? std::string("LABELS") : "LABELS" + std::to_string(part));
      if (more.empty()) break;
      names.insert(names.end(), more.begin(), more.end());
    }
    names.resize(points_);
    for (std::size_t i = 0; i < points_; ++i)
      if (names[i].empty()) names[i] = "point_" + std::to_string(i + 1);
  }

  // The head's 16 bits do not count far; TRIAL does in two halves, and LONG_FRAMES in a real.
  std::size_t frames() const {
    const auto half = [&](const char* name, std::size_t i) {
      return parameters_.whole("TRIAL", name, i);
    };
    const auto first = half("ACTUAL_START_FIELD", 0), last = half("ACTUAL_END_FIELD", 0);
    if (first && last) {
      const std::size_t from = *first + 65536 * half("ACTUAL_START_FIELD", 1).value_or(0);
      const std::size_t to = *last + 65536 * half("ACTUAL_END_FIELD", 1).value_or(0);
      if (to >= from) return to - from + 1;
    }
    if (const auto count = parameters_.whole("POINT", "LONG_FRAMES")) return *count;
    const std::size_t from = bytes_.word(C3dHead::first), to = bytes_.word(C3dHead::last);
    if (to < from) return 0;
    const std::size_t counted = to - from + 1;
    const auto stated = parameters_.whole("POINT", "FRAMES");
    return to == 65535 && stated ? std::max(counted, *stated) : counted;
  }

  void read_frames() {
    const bool reals = scale_ < 0.0;
    const std::size_t width = reals ? 4 : 2, per_frame = width * (4 * points_ + analog_);
    const std::size_t data =
        parameters_.whole("POINT", "DATA_START").value_or(bytes_.word(C3dHead::data));
    const std::size_t count = frames();
    if (data == 0 || !bytes_.has((data - 1) * block, 0)) {
      fail("the data begin in block " + std::to_string(data) + ", expected one within the file");
      return;
    }
    const std::size_t begin = (data - 1) * block, there = (bytes_.size() - begin) / per_frame;
    if (count == 0 || count > there) {
      fail("the head counts " + std::to_string(count) + " frames, and there are " +
           std::to_string(there) + " whole ones: expected as many (is the file cut off?)");
      return;
    }
    if (count * points_ > io::most_cells / 3) {
      fail("holds more than " + std::to_string(io::most_cells) +
           " numbers, expected fewer points "
           "or frames");
      return;
    }
    recording_.value.resize(static_cast<Eigen::Index>(count),
                            static_cast<Eigen::Index>(3 * points_));
    for (std::size_t f = 0; f < count; ++f)
      for (std::size_t p = 0; p < points_; ++p)
        read_point(f, p, begin + f * per_frame + 4 * width * p, reals);
    if (analog_ > 0)
      recording_.remarks.push_back(
          std::to_string(analog_) +
          " analog samples a frame are not read: export forces as a table");
  }

  void read_point(std::size_t frame, std::size_t point, std::size_t at, bool reals) {
    const bool seen = reals ? bytes_.real(at + 12) >= 0.0 : bytes_.signed_word(at + 6) >= 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double x = reals ? bytes_.real(at + 4 * axis) : scale_ * bytes_.signed_word(at + 2 * axis);
      if (!seen || !std::isfinite(x)) x = std::numeric_limits<double>::quiet_NaN();
      recording_.value(static_cast<Eigen::Index>(frame),
                       static_cast<Eigen::Index>(3 * point + axis)) = x;
    }
  }

  C3dBytes bytes_;
  std::string file_;
  Diagnostics& diagnostics_;
  int before_;
  C3dParameters parameters_;
  Recording recording_;
  std::size_t points_ = 0, analog_ = 0;
  double scale_ = bytes_.real(C3dHead::scale);
};

Recording read_c3d(const RecordingSource& source) {
  const std::string file = source.file.string();
  const auto refuse = [&](const std::string& what) {
    source.diagnostics.error({file}, what);
    return Recording{};
  };
  if (!is_c3d(source.bytes)) return refuse("is no C3D file, expected one that begins so");
  const std::size_t parameters = (static_cast<unsigned char>(source.bytes[0]) - 1) * block;
  if (source.bytes.size() < block || parameters < block || parameters + 4 > source.bytes.size())
    return refuse("ends before its parameters (" + std::to_string(source.bytes.size()) +
                  " bytes), expected a whole file");
  const int processor = static_cast<unsigned char>(source.bytes[parameters + 3]);
  if (processor < 84 || processor > 86)
    return refuse("processor type " + std::to_string(processor) +
                  " is unknown, expected 84 (Intel), 85 (DEC) or 86 (MIPS)");
  return C3dReader(source, static_cast<C3dProcessor>(processor), parameters).read();
}

}  // namespace

const RecordingFormat c3d_format = {"c3d", "C3D", false, is_c3d, read_c3d};

}  // namespace pedicel::discrepancy
