// Vicon Nexus: sections that end with an empty line. Of the section Trajectories: its name, the
// rate in Hz, a line of subjects and markers, a line Frame, Sub Frame, X, Y, Z, a line of units,
// rows.
#include <algorithm>
#include <array>

#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/headed_table.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::array sections = {"Trajectories", "Devices", "Model Outputs", "Joints",
                                 "Segments",     "Forces",  "Events",        "Bones"};

/// A line without the separators and blanks behind its first cell.
std::string_view first_cell(std::string_view text) {
  text = text.substr(0, text.find_first_of("\r\n"));
  while (!text.empty() && std::string_view(",;\t ").find(text.back()) != std::string_view::npos)
    text.remove_suffix(1);
  return text;
}

bool is_vicon(std::string_view head) {
  return std::ranges::any_of(sections, [&](const char* s) { return first_cell(head) == s; });
}

/// What parts the cells: the one that the line of axes has behind "Frame".
char vicon_separator(std::string_view text) {
  for (std::size_t at = text.find("\nFrame"); at != std::string_view::npos;
       at = text.find("\nFrame", at + 1))
    if (const char found = separator_behind(text.substr(at + 1), "Frame"); found != '\0')
      return found;
  return ',';
}

class ViconReader {
 public:
  explicit ViconReader(const RecordingSource& source)
      : table_(source.bytes, source.file.string(), vicon_separator(source.bytes),
               source.diagnostics) {}

  Recording read() {
    if (!find_section() || !read_head() || !table_.find_decimal_mark()) return {};
    read_rows();
    return std::move(recording_);
  }

 private:
  bool find_section() {
    while (table_.next())
      if (table_.cell(0) == "Trajectories") return true;
    table_.error(0, "no section Trajectories, expected an export with the markers' trajectories");
    return false;
  }

  bool read_head() {
    if (!table_.next_line() || !table_.is_number(0)) {
      table_.error(0, in_quotes(table_.cell(0)) + " is no rate, expected frames a second");
      return false;
    }
    recording_.rate = {table_.number(0), table_.at(0)};
    if (!table_.next_line()) return false;
    for (const io::TableCell& cell : table_.cells()) names_.emplace_back(cell.text);
    if (!table_.next_line() || table_.cell(0) != "Frame") {
      table_.error(0, "no line of axes, expected Frame,Sub Frame,X,Y,Z,...");
      return false;
    }
    for (const io::TableCell& cell : table_.cells()) axes_.emplace_back(cell.text);
    find_points();
    return read_units();
  }

  void find_points() {
    for (std::size_t c = 2; c + 2 < axes_.size(); ++c) {
      if (axes_[c] != "X" || axes_[c + 1] != "Y" || axes_[c + 2] != "Z") continue;
      if (c >= names_.size() || names_[c].empty()) continue;
      recording_.names.push_back(names_[c]);
      points_.push_back(c);
    }
  }

  // A line of units; absent in old exports, which then leave the unit open.
  bool read_units() {
    if (!table_.next_line()) return true;
    if (table_.is_number(0)) {
      table_.again();
      return true;
    }
    for (const std::size_t c : points_)
      for (std::size_t axis = c; axis < c + 3; ++axis) {
        const auto unit = io::unit_of(table_.cell(axis));
        const bool is_length = unit && unit->quantity == io::Quantity::length;
        if (!is_length || (recording_.unit.value && *recording_.unit.value != unit->factor)) {
          table_.error(axis,
                       "the unit is " + in_quotes(table_.cell(axis)) +
                           ", expected one of all markers: " + io::units_of(io::Quantity::length));
          return false;
        }
        recording_.unit = {unit->factor, table_.at(axis)};
      }
    return true;
  }

  // To the empty line that ends the section.
  void read_rows() {
    std::vector<double> rows;
    while (table_.next_line() && !table_.is_empty() && table_.count_row(axes_.size())) {
      recording_.frame.push_back(table_.number(0, true));
      for (const std::size_t c : points_)
        for (const double x : table_.point({c, c + 1, c + 2})) rows.push_back(x);
    }
    recording_.value = matrix_of_rows(rows, 3 * points_.size());
  }

  HeadedTable table_;
  Recording recording_;
  std::vector<std::string> names_, axes_;
  std::vector<std::size_t> points_;  // first column of each
};

}  // namespace

const RecordingFormat vicon_format = {"vicon", "Vicon Nexus CSV", true, is_vicon,
                                      read_with<ViconReader>};

}  // namespace pedicel::discrepancy
