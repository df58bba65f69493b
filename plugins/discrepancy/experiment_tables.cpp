#include "discrepancy/experiment_tables.h"

#include <algorithm>
#include <cmath>

#include "io/atomic_file.h"
#include "io/csv.h"
#include "io/table_text.h"
#include "io/text_file.h"

namespace pedicel::discrepancy {

namespace {

constexpr double smallest_quaternion = 1.0e-6;
constexpr const char* axes[] = {"x", "y", "z"};

/// A table of samples: time first and not negative, then the columns that are expected. Everything
/// comes in SI units, whatever unit the header says.
class SampleTable {
 public:
  SampleTable(const std::filesystem::path& file, bool gaps, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), before_(diagnostics.error_count()) {
    io::CsvRules rules;
    rules.empty_cells = gaps;
    table_ = io::read_csv(file, rules, diagnostics);
    if (!good()) return;
    const std::string& first = table_.columns.front();
    const std::string name = io::match_column(first, "t").matches ? "t" : "time";
    if (!io::match_column(first, name).matches)
      error(table_.header_line, 0, "the first column is " + in_quotes(first) + ", expected time");
    else if (!io::to_si(table_, 0, name, io::Quantity::time, diagnostics_))
      return;
    else if (table_.rows.front().front() < 0.0)
      error(table_.lines.front(), 0,
            "time " + io::exact_number(table_.rows.front().front()) +
                " is before the trial begins, expected >= 0");
  }

  bool good() const { return diagnostics_.error_count() == before_; }
  const io::CsvTable& table() const { return table_; }
  void error(int line, int column, const std::string& what) {
    diagnostics_.error(io::cell_position(table_, line, column), what);
  }
  /// The same in row after row is said once.
  void row_error(const char* kind, std::size_t row, int column, const std::string& what) {
    const int line = table_.lines[row];
    if (!diagnostics_.again(kind, {table_.file, line, 1}))
      diagnostics_.repeated_error(kind, io::cell_position(table_, line, column), what);
  }

  /// Each of `expected` once and nothing else, in any order: their indices.
  std::vector<int> find(const std::vector<std::string>& expected, io::Quantity quantity,
                        const std::string& all) {
    std::vector<int> found(expected.size(), -1);
    for (int c = 1; c < static_cast<int>(table_.columns.size()); ++c) {
      const std::string& name = table_.columns[c];
      const int index = index_of(expected, name);
      if (index < 0)
        error(table_.header_line, c, "column " + in_quotes(name) + " is unknown, expected " + all);
      else if (found[index] >= 0)
        error(table_.header_line, c,
              "column " + printable(name, 60) + " appears twice, expected it once");
      else
        found[index] = c;
    }
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (found[i] < 0)
        error(table_.header_line, 0, "no column " + expected[i] + ", expected " + all);
      else
        io::to_si(table_, found[i], expected[i],
                  is_quaternion(expected[i]) ? io::Quantity::none : quantity, diagnostics_);
    return found;
  }

  Samples samples(const std::vector<int>& columns) const {
    Samples samples;
    if (!good()) return samples;
    samples.value.resize(table_.rows.size(), columns.size());
    for (std::size_t r = 0; r < table_.rows.size(); ++r) {
      samples.time.push_back(table_.rows[r].front());
      for (std::size_t c = 0; c < columns.size(); ++c)
        samples.value(r, c) = table_.rows[r][columns[c]];
    }
    return samples;
  }

  /// The three cells of a point are all there or none is.
  void check_points(const std::vector<int>& columns) {
    for (std::size_t r = 0; r < table_.rows.size(); ++r)
      for (std::size_t c = 0; c + 2 < columns.size(); c += 3) {
        int there = 0, missing = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const bool empty = std::isnan(table_.rows[r][columns[c + axis]]);
          there += empty ? 0 : 1;
          if (empty) missing = columns[c + axis];
        }
        if (there != 0 && there != 3)
          row_error("half a point", r, missing,
                    table_.columns[missing] +
                        " is empty where the other axes are not, expected all three or none");
      }
  }

 private:
  static bool is_quaternion(const std::string& name) {
    return name.size() == 2 && name[0] == 'q' && name[1] >= 'w' && name[1] <= 'z';
  }
  // As it is written, else whatever its capitals and its unit.
  static int index_of(const std::vector<std::string>& expected, const std::string& name) {
    const auto exact = std::find(expected.begin(), expected.end(), name);
    if (exact != expected.end()) return static_cast<int>(exact - expected.begin());
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (io::match_column(name, expected[i]).matches) return static_cast<int>(i);
    return -1;
  }

  io::CsvTable table_;
  Diagnostics& diagnostics_;
  int before_;
};

std::string row_text(double time, const std::vector<double>& values) {
  std::string text = io::exact_number(time);
  for (const double value : values) text += "," + io::exact_number(value);
  return text + "\n";
}

std::string rows_text(const Samples& samples) {
  std::string text;
  for (int r = 0; r < samples.size(); ++r) {
    std::vector<double> values;
    for (int c = 0; c < samples.value.cols(); ++c) values.push_back(samples.value(r, c));
    text += row_text(samples.time[r], values);
  }
  return text;
}

}  // namespace

Path read_path(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SampleTable source(file, false, diagnostics);
  if (!source.good()) return {};
  const io::CsvTable& table = source.table();
  const bool turns = table.columns.size() > 4;
  std::vector<std::string> expected = {"x", "y", "z"};
  if (turns) expected.insert(expected.end(), {"qx", "qy", "qz", "qw"});
  const std::vector<int> at =
      source.find(expected, io::Quantity::length, "time,x,y,z or time,x,y,z,qx,qy,qz,qw");
  if (!source.good()) return {};
  Path path;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<double>& row = table.rows[r];
    path.time.push_back(row.front());
    path.position.emplace_back(row[at[0]], row[at[1]], row[at[2]]);
    if (!turns) continue;
    const Quat q(row[at[6]], row[at[3]], row[at[4]], row[at[5]]);
    if (q.norm() < smallest_quaternion)
      source.row_error("quaternion", r, at[3], "the quaternion has length 0, expected a rotation");
    path.rotation.push_back(q.normalized());
  }
  return source.good() ? path : Path{};
}

Samples read_markers(const std::filesystem::path& file, std::span<const Marker> markers,
                     Diagnostics& diagnostics) {
  SampleTable source(file, true, diagnostics);
  if (!source.good()) return {};
  std::vector<std::string> expected;
  std::string all = "time and x, y, z of each marker:";
  for (const Marker& marker : markers) {
    for (const char* axis : axes) expected.push_back(marker.name + "." + axis);
    all += " " + marker.name;
  }
  const std::vector<int> columns = source.find(expected, io::Quantity::length, all);
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SampleTable source(file, true, diagnostics);
  if (!source.good()) return {};
  const std::vector<int> columns =
      source.find({"fx", "fy", "fz"}, io::Quantity::force, "time,fx,fy,fz");
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

std::vector<MeasuredEvent> read_event_rows(const std::filesystem::path& file,
                                           std::vector<SourcePosition>& what_is_at,
                                           Diagnostics& diagnostics) {
  std::vector<MeasuredEvent> events;
  const std::string text = io::read_text_file(file);
  io::TableText table(text, file.string(), diagnostics);
  if (!table.good()) return events;
  const auto& columns = table.columns();
  std::string header;
  for (const io::TableColumn& column : columns) header += (header.empty() ? "" : ",") + column.name;
  constexpr const char* names[] = {"time", "event", "what", "by"};
  bool known = columns.size() == 3 || columns.size() == 4;
  for (std::size_t c = 0; known && c < columns.size(); ++c)
    known = io::match_column(columns[c].name, names[c]).matches;
  if (!known) {
    diagnostics.error({file.string(), table.header_line(), 1},
                      "the header is " + in_quotes(header) + ", expected time,event,what");
    return events;
  }
  std::string said = io::match_column(columns[0].name, "time").unit;
  if (said.empty()) said = columns[0].unit;
  const auto unit = said.empty() ? io::Unit{io::Quantity::time, 1.0} : io::unit_of(said);
  if (!unit || unit->quantity != io::Quantity::time) {
    diagnostics.error(
        {file.string(), table.header_line(), 1},
        "time is in " + in_quotes(said) + ", expected " + io::units_of(io::Quantity::time));
    return events;
  }
  while (table.next()) {
    MeasuredEvent event;
    event.time = table.number(0, false) * unit->factor;
    event.event = table.cells()[1].text;
    event.what = table.cells()[2].text;
    what_is_at.push_back(table.at(2));
    events.push_back(std::move(event));
  }
  return events;
}

std::vector<MeasuredEvent> read_events(const std::filesystem::path& file,
                                       const plant::PlantFile& plant, Diagnostics& diagnostics) {
  const auto is_fruit = [&](const std::string& name) {
    return std::ranges::any_of(plant.fruits, [&](const auto& f) { return f.name == name; });
  };
  std::vector<SourcePosition> places;
  const std::vector<MeasuredEvent> events = read_event_rows(file, places, diagnostics);
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i].is_detachment() && !is_fruit(events[i].what))
      diagnostics.repeated_error("no fruit", places[i],
                                 "what: " + in_quotes(events[i].what) + " is no fruit of plant \"" +
                                     plant.name + "\", expected the name of one that detached");
  return events;
}

std::string path_text(const Path& path) {
  std::string text = path.rotation.empty() ? "time,x,y,z\n" : "time,x,y,z,qx,qy,qz,qw\n";
  for (std::size_t r = 0; r < path.time.size(); ++r) {
    std::vector<double> values(path.position[r].begin(), path.position[r].end());
    if (!path.rotation.empty())
      for (const double q : path.rotation[r].coeffs()) values.push_back(q);
    text += row_text(path.time[r], values);
  }
  return text;
}

std::string markers_text(const Samples& samples, std::span<const Marker> markers) {
  std::string text = "time";
  for (const Marker& marker : markers)
    for (const char* axis : axes) text += "," + marker.name + "." + axis;
  return text + "\n" + rows_text(samples);
}

std::string force_text(const Samples& samples) {
  return "time,fx,fy,fz\n" + rows_text(samples);
}

std::string events_text(const std::vector<MeasuredEvent>& events) {
  std::string text = "time,event,what\n";
  for (const MeasuredEvent& event : events)
    text += io::exact_number(event.time) + "," + event.event + "," + event.what + "\n";
  return text;
}

}  // namespace pedicel::discrepancy
