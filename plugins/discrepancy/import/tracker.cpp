// Tracker (Open Source Physics): the name of a track, or "multi:" and a line with the names of
// several above their first columns; a line of variables that begins with t; rows. Lengths are in
// the unit that the calibration stick was given, which the file does not state.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/import/headed_table.h"
#include "plugins/discrepancy/import/recording_reader.h"

namespace pedicel::discrepancy {

namespace {

/// The first lines, without a mark of comments before them.
struct TrackerHead {
  std::vector<std::string_view> lines;  ///< above the variables
  std::string_view variables;
  char separator = '\0';  ///< '\0': this is no export of Tracker
};

/// What parts "t,x,y"; '\0' where the line is none of that kind.
char separator_of_variables(std::string_view line) {
  for (const char separator : {'\t', ',', ';', ' '}) {
    io::CellSplitter splitter(separator);
    const auto& cells = splitter.split(line);
    bool x = false, y = false;
    for (const io::TableCell& cell : cells) {
      x = x || cell.text == "x";
      y = y || cell.text == "y";
    }
    if (x && y && cells.front().text == "t") return separator;
  }
  return '\0';
}

TrackerHead tracker_head(std::string_view text) {
  constexpr std::size_t most = 4;  // lines above the rows
  TrackerHead head;
  io::RecordScanner scanner(text);
  while (head.lines.size() < most && scanner.next()) {
    std::string_view line = scanner.record();
    if (io::is_blank(line)) continue;
    if (line.starts_with('#')) line.remove_prefix(1);
    head.separator = separator_of_variables(line);
    if (head.separator != '\0') {
      head.variables = line;
      return head;
    }
    head.lines.push_back(line);
  }
  return head;
}

bool is_tracker(std::string_view text) {
  const TrackerHead head = tracker_head(text);
  return head.separator != '\0' && !head.lines.empty();
}

class TrackerReader {
 public:
  explicit TrackerReader(const RecordingSource& source)
      : head_(tracker_head(source.bytes)),
        table_(source.bytes, source.file.string(), head_.separator == '\0' ? ',' : head_.separator,
               source.diagnostics),
        file_(source.file) {}

  Recording read() {
    recording_.flat = true;
    if (head_.separator == '\0') {
      table_.error(0, "no line t, x, y above the rows, expected an export of Tracker");
      return {};
    }
    while (table_.next() && !is_variables()) {
    }
    find_points();
    if (table_.find_decimal_mark()) read_rows();
    return std::move(recording_);
  }

 private:
  bool is_variables() const { return table_.cell(0) == "t" || table_.cell(0) == "#t"; }

  // Each track has an x and a y of its own, in this order.
  void find_points() {
    const std::vector<std::string> names = names_above();
    for (std::size_t c = 1; c < table_.cells().size(); ++c) {
      if (table_.cell(c) != "x") continue;
      std::size_t y = c + 1;
      while (y < table_.cells().size() && table_.cell(y) != "y" && table_.cell(y) != "x") ++y;
      if (table_.cell(y) != "y") {
        table_.error(c, "x without a y behind it, expected both of every track");
        return;
      }
      recording_.names.push_back(name_of(names, c));
      x_.push_back(c);
      y_.push_back(y);
    }
  }

  /// Names by column; one alone is that of all columns.
  std::vector<std::string> names_above() const {
    if (head_.lines.empty()) return {};
    io::CellSplitter splitter(head_.separator);
    std::vector<std::string> names;
    for (const io::TableCell& cell : splitter.split(head_.lines.back()))
      names.emplace_back(cell.text);
    return names;
  }

  /// The nearest name at or before a column; without any, the file's.
  std::string name_of(const std::vector<std::string>& names, std::size_t c) const {
    for (std::size_t i = std::min(c + 1, names.size()); i-- > 0;)
      if (!names[i].empty()) return names[i];
    return file_.stem().string();
  }

  void read_rows() {
    std::vector<double> rows;
    while (table_.next() && table_.count_row(3 * x_.size() + 1)) {
      recording_.time.push_back(table_.number(0, true));
      for (std::size_t i = 0; i < x_.size(); ++i) {
        const std::vector<double> point = table_.point({x_[i], y_[i]});
        rows.push_back(point[0]);
        rows.push_back(point[1]);
        rows.push_back(std::isnan(point[0]) ? point[0] : 0.0);
      }
    }
    recording_.value = matrix_of_rows(rows, 3 * x_.size());
  }

  TrackerHead head_;
  HeadedTable table_;
  std::filesystem::path file_;
  Recording recording_;
  std::vector<std::size_t> x_, y_;  // columns
};

}  // namespace

const RecordingFormat tracker_format = {"tracker", "Tracker (OSP) table", true, is_tracker,
                                        read_with<TrackerReader>};

}  // namespace pedicel::discrepancy
