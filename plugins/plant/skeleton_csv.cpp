#include <algorithm>
#include <map>
#include <string_view>

#include "io/atomic_file.h"
#include "plant/mtg_reader.h"
#include "plant/text_cells.h"

namespace pedicel::plant {

namespace {

/// A row as it stands in the table.
struct Row {
  SkeletonNode node;
  int id = 0;
  std::optional<int> parent;  ///< an id
};

class TableParser {
 public:
  TableParser(std::string file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  std::vector<SkeletonNode> parse(std::string_view text) {
    const int before = diagnostics_.error_count();
    while (!text.empty()) {
      const std::string_view line = take_line(text);
      ++line_;
      const std::size_t first = line.find_first_not_of(" \t");
      if (first == std::string_view::npos || line[first] == '#') continue;
      const std::vector<TextCell> cells = split_cells(line, ',');
      if (columns_ > 0) {
        take_row(cells);
      } else if (!take_header(cells)) {
        return {};
      }
    }
    if (diagnostics_.error_count() == before && rows_.empty())
      error(1, "no rows, expected a header and one row a node");
    if (diagnostics_.error_count() > before) return {};
    std::vector<SkeletonNode> nodes = in_order();
    if (diagnostics_.error_count() > before) return {};
    return nodes;
  }

 private:
  void error(int column, std::string what) {
    diagnostics_.error({file_, line_, column}, std::move(what));
  }

  bool take_header(const std::vector<TextCell>& cells) {
    columns_ = cells.size();
    const auto column_of = [&](std::string_view name, std::string_view other) {
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].text == name || cells[i].text == other) return static_cast<int>(i);
      return -1;
    };
    x_[0] = column_of("x", "x_m");
    x_[1] = column_of("y", "y_m");
    x_[2] = column_of("z", "z_m");
    parent_ = column_of("parentid", "parent");
    id_ = column_of("vid", "id");
    edge_ = column_of("edgetype", "is_branch");
    diameter_ = column_of("diameter_m", "diameter_m");
    code_ = column_of("mtg_code", "mtg_code");
    if (std::min({x_[0], x_[1], x_[2], parent_, id_, edge_}) >= 0) return true;
    error(1,
          "a column is missing, expected x,y,z,parentid,vid,edgetype or "
          "id,parent,x_m,y_m,z_m,is_branch");
    return false;
  }

  void take_row(const std::vector<TextCell>& cells) {
    if (cells.size() != columns_) {
      error(1, std::to_string(cells.size()) + " cells, expected " + std::to_string(columns_) +
                   " as in the header");
      return;
    }
    Row row;
    row.node.where = {file_, line_, 1};
    for (int i = 0; i < 3; ++i) row.node.position[i] = number(cells[x_[i]]);
    row.id = whole(cells[id_]);
    const std::string_view parent = cells[parent_].text;
    if (!parent.empty() && parent != "nan" && parent != "-1") row.parent = whole(cells[parent_]);
    const TextCell& edge = cells[edge_];
    row.node.branch = edge.text == "+" || edge.text == "1";
    if (row.parent && !row.node.branch && edge.text != "<" && edge.text != "0")
      error(edge.column, "edge \"" + std::string(edge.text) +
                             "\", expected < (or 0) to follow or + (or 1) to branch");
    if (code_ >= 0) row.node.code = cells[code_].text;
    if (diameter_ >= 0 && !cells[diameter_].text.empty()) {
      row.node.diameter = number(cells[diameter_]);
      if (*row.node.diameter < 0.0)
        error(cells[diameter_].column,
              "diameter \"" + std::string(cells[diameter_].text) + "\", expected a number >= 0");
    }
    rows_.push_back(std::move(row));
  }

  double number(const TextCell& cell) {
    const std::optional<double> value = cell_number(cell.text);
    if (!value) error(cell.column, "\"" + std::string(cell.text) + "\", expected a number");
    return value.value_or(0.0);
  }

  int whole(const TextCell& cell) {
    const double value = number(cell);
    if (value == std::floor(value) && std::abs(value) < 2.0e9) return static_cast<int>(value);
    error(cell.column, "\"" + std::string(cell.text) + "\", expected a whole number");
    return 0;
  }

  // Parents before children, depth first, children in the order of their rows.
  std::vector<SkeletonNode> in_order() {
    const std::vector<int> parents = parent_rows();
    std::vector<std::vector<int>> children(rows_.size());
    std::vector<int> waiting;
    for (int r = static_cast<int>(rows_.size()) - 1; r >= 0; --r)
      (parents[r] >= 0 ? children[parents[r]] : waiting).push_back(r);
    if (waiting.size() > 1) {
      line_ = rows_[waiting[waiting.size() - 2]].node.where.line;
      error(1, "a second root, expected one row without a parent");
    }
    std::vector<SkeletonNode> nodes;
    std::vector<int> place(rows_.size(), -1);
    while (!waiting.empty()) {
      const int row = waiting.back();
      waiting.pop_back();
      place[row] = static_cast<int>(nodes.size());
      nodes.push_back(rows_[row].node);
      if (parents[row] >= 0) nodes.back().parent = place[parents[row]];
      waiting.insert(waiting.end(), children[row].begin(), children[row].end());
    }
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (place[r] < 0 && parents[r] >= 0) {
        line_ = rows_[r].node.where.line;
        error(1, "node " + std::to_string(rows_[r].id) +
                     " is its own ancestor, expected parents that lead to the root");
      }
    return nodes;
  }

  // The row of each row's parent, -1 without one.
  std::vector<int> parent_rows() {
    std::map<int, int> row_of;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      line_ = rows_[r].node.where.line;
      if (!row_of.emplace(rows_[r].id, static_cast<int>(r)).second)
        error(1, "node " + std::to_string(rows_[r].id) + " appears twice, expected it once");
    }
    std::vector<int> parents(rows_.size(), -1);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (!rows_[r].parent) continue;
      const auto found = row_of.find(*rows_[r].parent);
      if (found != row_of.end()) {
        parents[r] = found->second;
        continue;
      }
      line_ = rows_[r].node.where.line;
      error(1, "parent " + std::to_string(*rows_[r].parent) +
                   " is not there, expected the number of a node");
    }
    return parents;
  }

  std::string file_;
  Diagnostics& diagnostics_;
  int line_ = 0;
  std::size_t columns_ = 0;
  int x_[3] = {-1, -1, -1};
  int parent_ = -1, id_ = -1, edge_ = -1, diameter_ = -1, code_ = -1;
  std::vector<Row> rows_;
};

}  // namespace

std::vector<SkeletonNode> parse_skeleton_csv(const std::string& text, const std::string& file,
                                             Diagnostics& diagnostics) {
  return TableParser(file, diagnostics).parse(text);
}

std::optional<PlantFile> read_skeleton_csv(const std::filesystem::path& path,
                                           const MtgOptions& options, Diagnostics& diagnostics) {
  try {
    const auto nodes = parse_skeleton_csv(io::read_file(path), path.string(), diagnostics);
    return checked_skeleton_plant(nodes, path.stem().string(), options, diagnostics);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
}

}  // namespace pedicel::plant
