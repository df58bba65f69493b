#include "tests/discrepancy/score_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "engine/io/html_report.h"
#include "engine/plots/svg_heat_map.h"
#include "tests/discrepancy/score_table.h"

namespace pedicel::hidden {

namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
  return text.empty() ? "-" : text;
}

// Each row in percent of its cases; the columns' names stand in the list below the map.
std::string heat_map(const Confusion& confusion) {
  plots::HeatMap map;
  map.title = "What was hidden (rows) and what was said (columns)";
  map.x_label = "said: number of the list below";
  map.value_label = "% of the row's cases";
  map.levels = {1, 20, 40, 60, 80, 100};
  map.width = 960;
  for (std::size_t c = 0; c <= confusion.said.size(); ++c)
    map.edges.push_back(static_cast<double>(c) + 0.5);
  for (std::size_t r = 0; r < confusion.hidden.size(); ++r) {
    int all = 0;
    for (const int count : confusion.count[r]) all += count;
    map.rows.push_back(confusion.hidden[r] + " (" + std::to_string(all) + ")");
    std::vector<double> shares;
    for (const int count : confusion.count[r])
      shares.push_back(count ? 100.0 * count / all : std::numeric_limits<double>::quiet_NaN());
    map.value.push_back(shares);
  }
  return to_svg(map);
}

std::vector<std::vector<std::string>> case_rows(const std::vector<Score>& scores) {
  std::vector<std::vector<std::string>> rows;
  for (const Score& s : scores) {
    if (s.call == Call::right) continue;
    rows.push_back({std::to_string(s.number), joined(s.hidden), io::format_number(s.times),
                    s.plant + ", " + s.pack, s.coloured ? "coloured" : "white",
                    s.fault.empty() ? s.outcome : s.fault, joined(s.said), name_of(s.call)});
  }
  return rows;
}

std::string report_text(const std::vector<Score>& scores, std::uint64_t seed) {
  io::HtmlReport report("Hidden effects: found, missed, confused",
                        std::to_string(scores.size()) + " cases, seed " + std::to_string(seed));
  std::vector<std::vector<std::string>> rows;
  for (const TableRow& row : score_table(scores)) rows.push_back(cells(row));
  report.heading("Table");
  report.table({"figure", "reached", "95 % interval", "cases", "good", "extraordinary"}, rows);
  report.heading("Confusion");
  const Confusion matrix = confusion(scores);
  report.plot(heat_map(matrix));
  std::string names;
  for (std::size_t c = 0; c < matrix.said.size(); ++c)
    names += (c ? "; " : "") + std::to_string(c + 1) + " " + matrix.said[c];
  report.paragraph(names);
  report.heading("Cases that did not come out as they should");
  report.table({"case", "hidden", "times smallest", "trials", "noise", "verdict", "said", "call"},
               case_rows(scores));
  return report.text();
}

}  // namespace

std::vector<Score> read_scores(const fs::path& file, std::uint64_t seed) {
  std::map<int, Score> by_number;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    try {
      const Score one = from_line(line);
      if (one.seed == seed) by_number[one.number] = one;
    } catch (const std::exception&) {  // half a line
    }
  }
  std::vector<Score> scores;
  for (auto& [number, one] : by_number) scores.push_back(std::move(one));
  return scores;
}

void append_score(const fs::path& file, const Score& score) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  bool whole = true;  // does the last line end?
  if (std::ifstream in(file, std::ios::binary | std::ios::ate); in && in.tellg() > 0) {
    in.seekg(-1, std::ios::end);
    whole = in.get() == '\n';
  }
  std::ofstream out(file, std::ios::app);
  out << (whole ? "" : "\n") << to_line(score) << "\n" << std::flush;
  if (!out) throw io::WriteError(file.string() + ": cannot be written");
}

void write_score_report(const fs::path& folder, const std::vector<Score>& scores,
                        std::uint64_t seed) {
  const std::vector<TableRow> table = score_table(scores);
  const Confusion matrix = confusion(scores);
  io::write_file_atomically(folder / "table.md", markdown(table));
  io::write_file_atomically(folder / "table.csv", csv(table));
  io::write_file_atomically(folder / "confusion.md", markdown(matrix));
  io::write_file_atomically(folder / "confusion.csv", csv(matrix));
  io::write_file_atomically(folder / "report.html", report_text(scores, seed));
}

}  // namespace pedicel::hidden
