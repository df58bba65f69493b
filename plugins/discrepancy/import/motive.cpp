// OptiTrack Motive, versions 1.2 of its format: a line of keys and values; lines of types, names
// and identities; a line of what is measured (Rotation, Position, ...); a line of axes that begins
// with Frame; rows.
#include <algorithm>
#include <array>

#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/headed_table.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy {

namespace {

using io::same_but_case;

constexpr std::array types = {"Marker",      "Rigid Body", "Rigid Body Marker", "Bone",
                              "Bone Marker", "Skeleton",   "Skeleton Marker"};
constexpr std::array measures = {"Position", "Rotation", "Mean Marker Error", "Error Per Marker",
                                 "Marker Quality"};

bool is_motive(std::string_view head) {
  return separator_behind(head, "Format Version") != '\0';
}

/// Names of one column, from the lines of the head.
struct MotiveColumn {
  std::string type, name, measure;
};

class MotiveReader {
 public:
  explicit MotiveReader(const RecordingSource& source)
      : table_(source.bytes, source.file.string(), separator_behind(source.bytes, "Format Version"),
               source.diagnostics) {}

  Recording read() {
    if (!table_.next()) return {};
    read_keys();
    if (!read_head()) return {};
    find_points();
    if (table_.find_decimal_mark()) read_rows();
    return std::move(recording_);
  }

 private:
  void read_keys() {
    for (std::size_t c = 0; c + 1 < table_.cells().size(); c += 2) {
      const std::string_view key = table_.cell(c), value = table_.cell(c + 1);
      if (same_but_case(key, "Length Units")) take_unit(c + 1, value);
      if (same_but_case(key, "Coordinate Space") && !same_but_case(value, "Global"))
        table_.error(c + 1, "Coordinate Space is " + in_quotes(value) +
                                ", expected Global: export it again in global coordinates");
      if (same_but_case(key, "Export Frame Rate") ||
          (same_but_case(key, "Capture Frame Rate") && !recording_.rate.value))
        if (table_.is_number(c + 1)) recording_.rate = {table_.number(c + 1), table_.at(c + 1)};
    }
  }

  void take_unit(std::size_t column, std::string_view text) {
    const auto unit = io::unit_of(text);
    if (unit && unit->quantity == io::Quantity::length)
      recording_.unit = {unit->factor, table_.at(column)};
    else
      table_.error(column, "Length Units is " + in_quotes(text) + ", expected " +
                               io::units_of(io::Quantity::length));
  }

  template <class Words>
  static bool all_of(const std::vector<io::TableCell>& cells, std::size_t from,
                     const Words& words) {
    bool any = false;
    for (std::size_t c = from; c < cells.size(); ++c) {
      if (cells[c].text.empty()) continue;
      any = true;
      if (std::ranges::none_of(words,
                               [&](const char* w) { return same_but_case(cells[c].text, w); }))
        return false;
    }
    return any;
  }

  // Lines are told by what stands in them: older exports do not label them.
  bool read_head() {
    bool named = false;
    while (table_.next()) {
      const auto& cells = table_.cells();
      if (columns_.size() < cells.size()) columns_.resize(cells.size());
      if (same_but_case(table_.cell(0), "Frame")) {
        for (std::size_t c = 0; c < cells.size(); ++c) axes_.emplace_back(cells[c].text);
        if (!named) table_.error(0, "no line of names above, expected one");
        return named;
      }
      const std::string_view label = table_.cell(1);
      if (all_of(cells, 2, types)) {
        for (std::size_t c = 2; c < cells.size(); ++c) columns_[c].type = cells[c].text;
      } else if (all_of(cells, 2, measures)) {
        for (std::size_t c = 2; c < cells.size(); ++c) columns_[c].measure = cells[c].text;
      } else if (!named && !same_but_case(label, "ID") && !same_but_case(label, "Parent")) {
        for (std::size_t c = 2; c < cells.size(); ++c) columns_[c].name = cells[c].text;
        named = true;
      }
    }
    table_.error(
        0, "the head has no line that begins with Frame, expected Frame,Time (Seconds),X,Y,Z");
    return false;
  }

  bool is_point_at(std::size_t c) const {
    return c + 2 < axes_.size() && same_but_case(axes_[c], "X") &&
           same_but_case(axes_[c + 1], "Y") && same_but_case(axes_[c + 2], "Z") &&
           same_but_case(columns_[c].measure, "Position") &&
           columns_[c].name == columns_[c + 2].name;
  }

  // What was measured comes first: the markers. What Motive solved of a rigid body (its pivot,
  // where its markers should be) is taken where no marker has that name.
  void find_points() {
    std::size_t left_out = 0;
    for (const bool measured : {true, false})
      for (std::size_t c = 2; c < axes_.size(); ++c) {
        if (!is_point_at(c) || same_but_case(columns_[c].type, "Marker") != measured) continue;
        if (!measured && recording_.index_of(columns_[c].name) >= 0) {
          ++left_out;
          continue;
        }
        recording_.names.push_back(columns_[c].name);
        points_.push_back(c);
      }
    if (left_out > 0)
      recording_.remarks.push_back(
          std::to_string(left_out) +
          " solved points with the name of a measured marker are not read");
  }

  bool is_time() const {
    std::string begin = axes_.size() > 1 ? axes_[1].substr(0, 4) : "";
    return same_but_case(begin, "Time");
  }

  void read_rows() {
    std::vector<double> rows;
    while (table_.next() && table_.count_row(3 * points_.size() + 2)) {
      recording_.frame.push_back(table_.number(0, true));
      if (is_time()) recording_.time.push_back(table_.number(1, true));
      for (const std::size_t c : points_)
        for (const double x : table_.point({c, c + 1, c + 2})) rows.push_back(x);
    }
    recording_.value = matrix_of_rows(rows, 3 * points_.size());
  }

  HeadedTable table_;
  Recording recording_;
  std::vector<MotiveColumn> columns_;
  std::vector<std::string> axes_;
  std::vector<std::size_t> points_;  // first column of each
};

}  // namespace

const RecordingFormat motive_format = {
    "motive",  "OptiTrack Motive CSV",  true,
    is_motive, read_with<MotiveReader>, "does not begin with Format Version"};

}  // namespace pedicel::discrepancy
