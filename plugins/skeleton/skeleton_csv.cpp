#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "engine/io/unit_text.h"
#include "plugins/plant/point_grid.h"
#include "plugins/skeleton/mtg_reader.h"
#include "plugins/skeleton/skeleton_columns.h"
#include "plugins/skeleton/skeleton_tree.h"

namespace pedicel::plant {

namespace {

constexpr std::size_t most_rows = 1000000;
constexpr double end_of_another = 5.0e-4;  ///< m, by the four digits that programs write
constexpr double largest_whole = 9.0e15;   ///< doubles below it have no fractions left out

/// A row as it stands in the table.
struct Row {
  SkeletonRow link;
  Vec3 start = Vec3::Zero(), position = Vec3::Zero();  ///< m; `start` of a cylinder
  std::optional<double> diameter;                      ///< m
  std::string edge, code;
  int edge_column = 1;
  std::optional<std::int64_t> branch, order, extension;
};

// TreeQSM and Helios name three columns by one word: "start_point" and "axis_direction".
std::string with_three_names(std::string_view text) {
  std::size_t start = 0, end = 0;
  for (; start < text.size(); start = end + 1) {
    end = std::min(text.find_first_of("\r\n", start), text.size());
    if (end > start && text[start] != '#') break;
  }
  if (start >= text.size()) return {};  // comments alone
  std::string header(text.substr(start, end - start));
  bool changed = false;
  for (const std::string name : {"start_point", "axis_direction"}) {
    const std::size_t at = header.find(name), behind = at + name.size();
    if (at == std::string::npos || behind >= header.size() || header[behind] == '_') continue;
    const std::string parted = header[behind] + name;
    header.insert(behind, "_x" + parted + "_y" + parted + "_z");
    changed = true;
  }
  if (!changed) return {};
  return std::string(text.substr(0, start)) + header + std::string(text.substr(end));
}

class TableParser {
 public:
  TableParser(std::string_view text, const std::string& file, double unit, Diagnostics& diagnostics)
      : diagnostics_(diagnostics),
        before_(diagnostics.error_count()),
        table_(text, file, diagnostics) {
    if (table_.good()) columns_ = find_skeleton_columns(table_, unit, diagnostics);
  }

  std::vector<SkeletonNode> parse() {
    if (!good()) return {};
    while (table_.next() && take_row()) {
    }
    if (passed_over_ > 0)
      diagnostics_.warning({table_.file(), table_.header_line(), 1},
                           std::to_string(passed_over_) +
                               (passed_over_ == 1 ? " row without a place is passed over"
                                                  : " rows without a place are passed over"));
    if (good() && rows_.empty())
      error({table_.file(), table_.header_line(), 1},
            "no rows, expected a header and one row a node");
    if (good()) number_points();
    if (good()) check_ids();
    if (!good()) return {};
    const SkeletonTree tree = skeleton_tree(links(), diagnostics_);
    if (!good()) return {};
    return is_cylinders() ? cylinder_nodes(tree) : plain_nodes(tree);
  }

 private:
  bool good() const { return diagnostics_.error_count() == before_; }
  bool is_cylinders() const { return columns_.kind == SkeletonColumns::Kind::cylinders; }
  void error(const SourcePosition& where, const std::string& what) {
    diagnostics_.error(where, what);
  }

  std::vector<SkeletonRow> links() const {
    std::vector<SkeletonRow> list;
    for (const Row& row : rows_) list.push_back(row.link);
    return list;
  }

  bool take_row() {
    if (rows_.size() == most_rows) {
      error(table_.at(0),
            "the table goes on, expected at most " + std::to_string(most_rows) + " nodes");
      return false;
    }
    if (has_no_place()) {
      ++passed_over_;
      return true;
    }
    Row row;
    row.link.where = {table_.file(), table_.line(), 1};
    row.link.id = columns_.has(ColumnRole::id) ? whole(ColumnRole::id)
                                               : std::optional<std::int64_t>(rows_.size() + 1);
    row.link.parent = whole(ColumnRole::parent);
    if (is_cylinders())
      take_cylinder(row);
    else
      take_node(row);
    take_diameter(row);
    rows_.push_back(std::move(row));
    return true;
  }

  // OpenAlea's tables hold a plant's coarser scales, too, which lie nowhere.
  bool has_no_place() const {
    if (is_cylinders()) return false;
    for (const ColumnRole role : {ColumnRole::x, ColumnRole::y, ColumnRole::z})
      if (io::number_of(table_.cells()[columns_.column(role)].text).kind !=
          io::NumberText::Kind::missing)
        return false;
    return true;
  }

  void take_node(Row& row) {
    row.position = point(ColumnRole::x);
    if (columns_.has(ColumnRole::edge)) {
      const io::TableCell& edge = table_.cells()[columns_.column(ColumnRole::edge)];
      row.edge = edge.text.substr(0, 40);
      row.edge_column = edge.column;
    }
    if (columns_.has(ColumnRole::code))
      row.code = table_.cells()[columns_.column(ColumnRole::code)].text;
  }

  void take_cylinder(Row& row) {
    row.start = point(ColumnRole::start_x);
    row.position = columns_.has(ColumnRole::end_x)
                       ? point(ColumnRole::end_x)
                       : row.start + length(ColumnRole::length) * direction();
    if (columns_.has(ColumnRole::branch)) row.branch = whole(ColumnRole::branch);
    if (columns_.has(ColumnRole::order)) row.order = whole(ColumnRole::order);
    if (columns_.has(ColumnRole::extension)) row.extension = whole(ColumnRole::extension);
  }

  Vec3 direction() {
    Vec3 axis;
    for (int i = 0; i < 3; ++i)
      axis[i] = table_.number(columns_.column(ColumnRole(static_cast<int>(ColumnRole::axis_x) + i)),
                              false);
    const double norm = axis.norm();
    return norm > 0.0 ? Vec3(axis / norm) : axis;
  }

  void take_diameter(Row& row) {
    const ColumnRole role =
        columns_.has(ColumnRole::diameter) ? ColumnRole::diameter : ColumnRole::radius;
    if (!columns_.has(role)) return;
    const auto column = static_cast<std::size_t>(columns_.column(role));
    const double value = table_.number(column, true);
    if (std::isnan(value)) return;
    if (value < 0.0)
      table_.cell_error(column, "negative diameter",
                        in_quotes(table_.cells()[column].text) + ", expected a number >= 0");
    row.diameter = value * columns_.factor(role) * (role == ColumnRole::radius ? 2.0 : 1.0);
  }

  double length(ColumnRole role) {
    return table_.number(columns_.column(role), false) * columns_.factor(role);
  }

  Vec3 point(ColumnRole first) {
    Vec3 place;
    for (int i = 0; i < 3; ++i) place[i] = length(ColumnRole(static_cast<int>(first) + i));
    return place;
  }

  // Some programs write them as 12.0. Digits alone are read as they stand, so that large ones are
  // exact.
  std::optional<std::int64_t> whole(ColumnRole role) {
    const auto column = static_cast<std::size_t>(columns_.column(role));
    const std::string_view text = table_.cells()[column].text;
    std::int64_t value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault == std::errc{} && end == text.data() + text.size()) return value;
    const double number = table_.number(column, true);
    if (std::isnan(number)) return std::nullopt;
    if (number == std::floor(number) && std::abs(number) < largest_whole)
      return static_cast<std::int64_t>(number);
    table_.cell_error(column, "no whole number", in_quotes(text) + ", expected a whole number");
    return 0;
  }

  // Tables that hold points, and beside them the edges of the tree: `vid` hangs from `parentid`,
  // both numbers of points from 0. There is an edge less than points, so that the last row has
  // none.
  bool is_points_and_edges() const {
    const auto points = static_cast<std::int64_t>(rows_.size());
    const Row& last = rows_.back();
    if (is_cylinders() || points < 2 || last.link.id || last.link.parent || !last.edge.empty())
      return false;
    const auto is_point = [&](const std::optional<std::int64_t>& number) {
      return number && *number >= 0 && *number < points;
    };
    return std::all_of(rows_.begin(), rows_.end() - 1, [&](const Row& row) {
      return is_point(row.link.id) && is_point(row.link.parent);
    });
  }

  void number_points() {
    if (!is_points_and_edges()) return;
    const std::vector<Row> edges(rows_.begin(), rows_.end() - 1);
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      rows_[r].link.id = static_cast<std::int64_t>(r);
      rows_[r].link.parent.reset();
      rows_[r].edge.clear();
    }
    std::vector<bool> hangs(rows_.size(), false);
    for (const Row& edge : edges) {
      Row& child = rows_[*edge.link.id];
      if (hangs[*edge.link.id])
        error(edge.link.where, "point " + std::to_string(*edge.link.id) +
                                   " hangs from two, expected one edge to each");
      hangs[*edge.link.id] = true;
      child.link.parent = edge.link.parent;
      child.edge = edge.edge;
      child.edge_column = edge.edge_column;
    }
    diagnostics_.warning({table_.file(), table_.header_line(), 1},
                         "the last row has a point and no edge, so parentid and vid are taken for "
                         "edges between the points, which are counted from 0");
  }

  void check_ids() {
    for (const Row& row : rows_)
      if (!row.link.id)
        diagnostics_.repeated_error("no id", row.link.where,
                                    table_.columns()[columns_.column(ColumnRole::id)].name +
                                        " is empty, expected the number of the node");
  }

  static bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [&](std::string_view word) { return io::same_but_case(text, word); });
  }
  static bool branches(const Row& row) { return is_one_of(row.edge, {"+", "1", "1.0", "true"}); }

  // "/" is a part's first one, which goes on where its whole does.
  bool begins_axis(const Row& row) {
    if (!columns_.has(ColumnRole::edge)) return false;
    if (branches(row)) return true;
    if (!is_one_of(row.edge, {"<", "/", "0", "0.0", "false"}))
      diagnostics_.repeated_error("edge", {table_.file(), row.link.where.line, row.edge_column},
                                  table_.columns()[columns_.column(ColumnRole::edge)].name + ": " +
                                      in_quotes(row.edge) +
                                      ", expected < (or 0) to follow or + (or 1) to branch");
    return false;
  }

  std::vector<SkeletonNode> plain_nodes(const SkeletonTree& tree) {
    std::vector<SkeletonNode> nodes;
    std::vector<int> place(rows_.size(), -1);
    for (const int r : tree.order) {
      const Row& row = rows_[r];
      const bool is_root = tree.parent[r] < 0;
      place[r] = static_cast<int>(nodes.size());
      nodes.push_back({is_root ? -1 : place[tree.parent[r]], row.position, row.diameter,
                       is_root ? branches(row) : begins_axis(row), row.code, row.link.where});
    }
    if (!good()) nodes.clear();
    return nodes;
  }

  // The same branch as its parent's: by the branches' names, their order, or TreeQSM's extensions.
  bool continues(const Row& row, const Row& parent) const {
    if (row.branch && parent.branch) return *row.branch == *parent.branch;
    if (row.order && parent.order) return *row.order == *parent.order;
    if (parent.extension) return *parent.extension == *row.link.id;
    return true;
  }

  // Helios writes the row before as the parent of a branch. Where a branch begins far from what it
  // is said to hang from, and just where another cylinder ends, it hangs from that one; -1: it does
  // not.
  int end_at(const Row& row, const Row& parent, const PointGrid& ends) {
    const Vec3 along = parent.position - parent.start;
    const double length = along.squaredNorm();
    const double at =
        length > 0.0 ? std::clamp((row.start - parent.start).dot(along) / length, 0.0, 1.0) : 0.0;
    const double away = (row.start - parent.start - at * along).norm();
    if (away <= 2.0 * parent.diameter.value_or(0.0) + end_of_another) return -1;
    const int found = ends.nearest(row.start).point;
    if (found >= 0 && !said_of_parents_) {
      said_of_parents_ = true;
      diagnostics_.warning(row.link.where,
                           "a branch is said to hang from a cylinder that is not there where it "
                           "begins, and is hung from the one that ends there");
    }
    return found;
  }

  // A node at every cylinder's end, one at the root's start, and one where a branch begins away
  // from the axis that carries it. A branch hangs from whichever end of its parent is nearer.
  std::vector<SkeletonNode> cylinder_nodes(const SkeletonTree& tree) {
    constexpr double at_junction = 1.0e-6;  // m
    PointGrid ends(end_of_another);
    std::vector<SkeletonNode> nodes;
    std::vector<int> start_of(rows_.size(), -1), end_of(rows_.size(), -1), node_at_end;
    const auto add = [&](int from, const Vec3& at, bool branch, const Row& row) {
      nodes.push_back({from, at, row.diameter, branch, row.code, row.link.where});
      return static_cast<int>(nodes.size()) - 1;
    };
    const auto add_end = [&](const Vec3& at, int node) {
      ends.add(at);
      node_at_end.push_back(node);
    };
    for (const int r : tree.order) {
      const Row& row = rows_[r];
      const int p = tree.parent[r];
      int from = p < 0 ? add(-1, row.start, false, row) : end_of[p];
      if (p < 0) add_end(row.start, from);
      bool branch = p >= 0 && !continues(row, rows_[p]);
      const int other = branch ? end_at(row, rows_[p], ends) : -1;
      if (other >= 0)
        from = node_at_end[other];
      else if (p >= 0 && (nodes[start_of[p]].position - row.start).norm() <
                             (nodes[from].position - row.start).norm()) {
        from = start_of[p];
        branch = true;
      }
      if (branch && other < 0 && (nodes[from].position - row.start).norm() > at_junction) {
        from = add(from, row.start, true, row);
        branch = false;
      }
      start_of[r] = from;
      end_of[r] = add(from, row.position, branch, row);
      add_end(row.position, end_of[r]);
    }
    return nodes;
  }

  Diagnostics& diagnostics_;
  int before_;
  io::TableText table_;
  SkeletonColumns columns_;
  std::vector<Row> rows_;
  std::size_t passed_over_ = 0;
  bool said_of_parents_ = false;
};

}  // namespace

std::vector<SkeletonNode> parse_skeleton_csv(const std::string& text, const std::string& file,
                                             Diagnostics& diagnostics, double unit) {
  const std::string named = with_three_names(text);
  return TableParser(named.empty() ? text : named, file, unit, diagnostics).parse();
}

}  // namespace pedicel::plant
