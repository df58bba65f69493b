// Qualisys Track Manager, 3D data as TSV: lines of a key and its values, then rows of x, y, z of
// every marker in mm, with frame and time before them where the export was told to write them.
#include <cmath>
#include <limits>

#include "engine/io/unit_text.h"
#include "plugins/discrepancy/import/headed_table.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy {

namespace {

bool is_qualisys(std::string_view head) {
  const std::size_t at = head.find("NO_OF_FRAMES");
  if (at == std::string_view::npos || (at > 0 && head[at - 1] != '\n' && head[at - 1] != '\r'))
    return false;
  return separator_behind(head.substr(at), "NO_OF_FRAMES") != '\0';
}

class QualisysReader {
 public:
  explicit QualisysReader(const RecordingSource& source)
      : table_(source.bytes, source.file.string(),
               separator_behind(source.bytes.substr(source.bytes.find("NO_OF_FRAMES")),
                                "NO_OF_FRAMES"),
               source.diagnostics) {}

  Recording read() {
    if (!read_head() || !table_.find_decimal_mark()) return {};
    read_rows();
    if (unseen_ > 0)
      recording_.remarks.push_back(std::to_string(unseen_) +
                                   " points at exactly 0, 0, 0 count as not seen, as Qualisys "
                                   "writes them");
    return std::move(recording_);
  }

 private:
  // Until the first row of numbers.
  bool read_head() {
    while (table_.next()) {
      const std::string_view key = table_.cell(0);
      if (key == "FREQUENCY" && table_.is_number(1)) {
        recording_.rate = {table_.number(1), table_.at(1)};
      } else if (key == "DATA_INCLUDED" && table_.cell(1) != "3D") {
        table_.error(1, "DATA_INCLUDED is " + in_quotes(table_.cell(1)) +
                            ", expected 3D: export the markers' 3D data");
        return false;
      } else if (key == "MARKER_NAMES") {
        for (std::size_t c = 1; c < table_.cells().size(); ++c)
          if (!table_.cell(c).empty()) recording_.names.emplace_back(table_.cell(c));
      } else if (is_row()) {
        table_.again();
        return check_names();
      }
    }
    table_.error(0, "no row of numbers behind the head, expected x, y, z of every marker");
    return false;
  }

  // With a decimal comma, too: the mark is told of the rows alone.
  bool is_row() const {
    for (const io::TableCell& cell : table_.cells()) {
      const bool point = io::number_of(cell.text, {'.'}).kind != io::NumberText::Kind::other;
      const bool comma = io::number_of(cell.text, {','}).kind != io::NumberText::Kind::other;
      if (!point && !comma) return false;
    }
    return true;
  }

  bool check_names() {
    if (!recording_.names.empty()) return true;
    table_.error(0, "rows before MARKER_NAMES, expected the markers' names in the head");
    return false;
  }

  void read_rows() {
    const std::size_t wanted = 3 * recording_.names.size();
    std::vector<double> rows;
    while (table_.next() && table_.count_row(wanted + 2)) {
      std::size_t there = table_.cells().size();
      while (there > 0 && table_.cell(there - 1).empty() && there > wanted + 2) --there;
      const bool counted = there == wanted + 2;
      // One separator more ends the rows of some versions.
      if (!counted && there != wanted && !(there == wanted + 1 && table_.cell(wanted).empty())) {
        table_.error(0, std::to_string(there) + " cells, expected " + std::to_string(wanted) +
                            " (x, y, z of " + std::to_string(recording_.names.size()) +
                            " markers) or " + std::to_string(wanted + 2) +
                            " (frame and time before them)");
        return;
      }
      if (counted) {
        recording_.frame.push_back(table_.number(0, true));
        recording_.time.push_back(table_.number(1, true));
      }
      for (std::size_t m = 0; m < recording_.names.size(); ++m)
        add_point(rows, 3 * m + (counted ? 2 : 0));
    }
    recording_.value = matrix_of_rows(rows, wanted);
  }

  void add_point(std::vector<double>& rows, std::size_t column) {
    const std::vector<double> point = table_.point({column, column + 1, column + 2});
    const bool unseen = point[0] == 0.0 && point[1] == 0.0 && point[2] == 0.0;
    unseen_ += unseen ? 1 : 0;
    for (const double x : point)
      rows.push_back(unseen ? std::numeric_limits<double>::quiet_NaN() : x);
  }

  HeadedTable table_;
  Recording recording_;
  std::size_t unseen_ = 0;
};

}  // namespace

const RecordingFormat qualisys_format = {"qualisys",
                                         "Qualisys TSV",
                                         true,
                                         is_qualisys,
                                         read_with<QualisysReader>,
                                         "has no line NO_OF_FRAMES"};

}  // namespace pedicel::discrepancy
