#include "discrepancy/experiment_tables.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "io/atomic_file.h"
#include "io/csv.h"

namespace pedicel::discrepancy {

namespace {

constexpr double smallest_quaternion = 1.0e-6;
constexpr const char* axes[] = {"x", "y", "z"};

/// A table of samples: time first and not negative, then the columns that are expected.
class SampleTable {
 public:
  SampleTable(const std::filesystem::path& file, bool gaps, Diagnostics& diagnostics)
      : diagnostics_(diagnostics), before_(diagnostics.error_count()) {
    io::CsvRules rules;
    rules.empty_cells = gaps;
    table_ = io::read_csv(file, rules, diagnostics);
    if (!good()) return;
    if (table_.columns.front() != "time")
      error(table_.header_line, 0,
            "the first column is \"" + table_.columns.front() + "\", expected time");
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

  /// Each of `expected` once and nothing else, in any order: their indices.
  std::vector<int> find(const std::vector<std::string>& expected, const std::string& all) {
    std::vector<int> found;
    for (const std::string& name : expected) {
      found.push_back(table_.column(name));
      if (found.back() < 0) error(table_.header_line, 0, "no column " + name + ", expected " + all);
    }
    const std::set<std::string> known(expected.begin(), expected.end());
    std::set<std::string> seen;
    for (int c = 1; c < static_cast<int>(table_.columns.size()); ++c) {
      const std::string& name = table_.columns[c];
      if (!known.contains(name))
        error(table_.header_line, c, "column \"" + name + "\" is unknown, expected " + all);
      else if (!seen.insert(name).second)
        error(table_.header_line, c, "column " + name + " appears twice, expected it once");
    }
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
          error(table_.lines[r], missing,
                table_.columns[missing] +
                    " is empty where the other axes are not, expected all "
                    "three or none");
      }
  }

 private:
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
  const std::vector<int> at = source.find(expected, "time,x,y,z or time,x,y,z,qx,qy,qz,qw");
  if (!source.good()) return {};
  Path path;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::vector<double>& row = table.rows[r];
    path.time.push_back(row.front());
    path.position.emplace_back(row[at[0]], row[at[1]], row[at[2]]);
    if (!turns) continue;
    const Quat q(row[at[6]], row[at[3]], row[at[4]], row[at[5]]);
    if (q.norm() < smallest_quaternion)
      source.error(table.lines[r], at[3], "the quaternion has length 0, expected a rotation");
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
  const std::vector<int> columns = source.find(expected, all);
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

Samples read_force(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SampleTable source(file, true, diagnostics);
  if (!source.good()) return {};
  const std::vector<int> columns = source.find({"fx", "fy", "fz"}, "time,fx,fy,fz");
  if (source.good()) source.check_points(columns);
  return source.samples(columns);
}

std::vector<MeasuredEvent> read_events(const std::filesystem::path& file,
                                       const plant::PlantFile& plant, Diagnostics& diagnostics) {
  const auto is_fruit = [&](const std::string& name) {
    return std::ranges::any_of(plant.fruits, [&](const auto& f) { return f.name == name; });
  };
  std::istringstream text(io::read_file(file));
  std::vector<MeasuredEvent> events;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    if (number == 1) {
      if (line != "time,event,what")
        diagnostics.error({file.string(), 1, 1},
                          "the header is \"" + line + "\", expected time,event,what");
      continue;
    }
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    MeasuredEvent event;
    const char* begin = line.data();
    const char* end = begin + std::min(first, line.size());
    const auto [stop, fault] = std::from_chars(begin, end, event.time);
    if (second == std::string::npos || line.find(',', second + 1) != std::string::npos) {
      diagnostics.error({file.string(), number, 1}, "expected three cells: time,event,what");
    } else if (fault != std::errc{} || stop != end || !std::isfinite(event.time)) {
      diagnostics.error({file.string(), number, 1},
                        "time: \"" + line.substr(0, first) + "\" is not a finite number");
    } else {
      event.event = line.substr(first + 1, second - first - 1);
      event.what = line.substr(second + 1);
      if (event.is_detachment() && !is_fruit(event.what))
        diagnostics.error({file.string(), number, static_cast<int>(second) + 2},
                          "what: \"" + event.what + "\" is no fruit of plant \"" + plant.name +
                              "\", expected the name of one that detached");
      events.push_back(std::move(event));
    }
  }
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
