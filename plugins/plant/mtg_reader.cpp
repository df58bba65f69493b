#include "plant/mtg_reader.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "io/atomic_file.h"
#include "plant/text_cells.h"

namespace pedicel::plant {

namespace {

// [^] then once or more: a relation, a class, an index where it has one.
bool is_code(std::string_view code) {
  if (!code.empty() && code.front() == '^') code.remove_prefix(1);
  bool any = false;
  while (!code.empty()) {
    const char relation = code.front();
    if (relation != '/' && relation != '<' && relation != '+') return false;
    code.remove_prefix(relation != '/' && code.size() > 1 && code[1] == relation ? 2 : 1);
    const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
    const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
    const auto letters = std::find_if_not(code.begin(), code.end(), is_letter);
    if (letters == code.begin()) return false;
    const auto digits = std::find_if_not(letters, code.end(), is_digit);
    code.remove_prefix(static_cast<std::size_t>(digits - code.begin()));
    any = true;
  }
  return any;
}

class MtgParser {
 public:
  MtgParser(std::string file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  std::vector<SkeletonNode> parse(std::string_view text) {
    const int before = diagnostics_.error_count();
    bool in_mtg = false;
    while (!text.empty() && !refused_header_) {
      const std::string_view line = take_line(text);
      ++line_;
      const std::size_t first = line.find_first_not_of(" \t");
      if (first == std::string_view::npos || line[first] == '#') continue;
      const std::vector<TextCell> cells = split_cells(line, '\t');
      if (!in_mtg)
        in_mtg = cells.front().text.starts_with("MTG");
      else if (code_columns_ == 0)
        take_header(cells);
      else
        take_entity(cells);
    }
    if (diagnostics_.error_count() == before) check_whole(in_mtg);
    if (diagnostics_.error_count() > before) nodes_.clear();
    return std::move(nodes_);
  }

 private:
  void error(int column, std::string what) {
    diagnostics_.error({file_, line_, column}, std::move(what));
  }

  void check_whole(bool in_mtg) {
    if (!in_mtg)
      error(1, "no line \"MTG:\", expected an MTG text with that section");
    else if (code_columns_ == 0)
      error(1, "no line \"ENTITY-CODE\" after \"MTG:\", expected the names of the columns");
    else if (nodes_.empty())
      error(1, "no entity has coordinates, expected XX, YY and ZZ in mm");
  }

  void take_header(const std::vector<TextCell>& cells) {
    refused_header_ = true;
    if (cells.front().text != "ENTITY-CODE") {
      error(cells.front().column, "\"" + std::string(cells.front().text) +
                                      "\", expected ENTITY-CODE and the names of the columns");
      return;
    }
    const auto is_named = [](const TextCell& cell) { return !cell.text.empty(); };
    const auto named = std::find_if(cells.begin() + 1, cells.end(), is_named);
    std::string names;
    for (auto cell = named; cell != cells.end(); ++cell)
      if (is_named(*cell)) names += (names.empty() ? "" : ", ") + std::string(cell->text);
    const auto column_of = [&](std::string_view name) {
      const auto same = [&](const TextCell& cell) { return cell.text == name; };
      const auto found = std::find_if(named, cells.end(), same);
      return found == cells.end() ? -1 : static_cast<int>(found - cells.begin());
    };
    const std::string axes[] = {"XX", "YY", "ZZ"};
    std::string missing;
    for (int i = 0; i < 3; ++i) {
      coordinates_[i] = column_of(axes[i]);
      if (coordinates_[i] < 0) missing += (missing.empty() ? "" : ", ") + axes[i];
    }
    refused_header_ = !missing.empty();
    if (refused_header_)
      error(cells.front().column, "no column " + missing + " beside " +
                                      (names.empty() ? "ENTITY-CODE" : names) +
                                      ", expected the coordinates XX, YY and ZZ in mm");
    diameter_ = column_of("TopDia");
    code_columns_ = static_cast<int>(named - cells.begin());
  }

  void take_entity(const std::vector<TextCell>& cells) {
    int column = -1;
    for (int i = 0; i < std::min(code_columns_, static_cast<int>(cells.size())); ++i) {
      if (cells[i].text.empty()) continue;
      if (column >= 0) {
        error(cells[i].column, "a second entity in the line, expected one");
        return;
      }
      column = i;
    }
    if (column < 0) {
      error(1, "no entity in the line, expected one in the first " + std::to_string(code_columns_) +
                   " columns");
      return;
    }
    const TextCell& code = cells[column];
    if (!is_code(code.text))
      error(code.column, "\"" + std::string(code.text) +
                             "\", expected an entity such as ^<E2, +B95/E1 or /E1<<E5");
    const int node = add_node(cells, code, parent_of(code, column));
    depth_.resize(static_cast<std::size_t>(column), -1);
    depth_.push_back(node);
  }

  // The nearest digitised node above: entities without coordinates pass their own one on.
  int parent_of(const TextCell& code, int column) {
    const bool follows = !code.text.empty() && code.text.front() == '^';
    const int above = follows ? column : column - 1;
    // The first entities are those of the whole plant; nothing is above the very first one.
    if (depth_.empty() || above < 0) return -1;
    if (above < static_cast<int>(depth_.size())) return depth_[above];
    error(code.column, follows
                           ? "\"^\" follows nothing, expected an entity above it in the same column"
                           : "the entity hangs from nothing, expected one in the column before it");
    return -1;
  }

  int add_node(const std::vector<TextCell>& cells, const TextCell& code, int parent) {
    std::optional<double> values[3];
    for (int i = 0; i < 3; ++i) values[i] = number(cells, coordinates_[i]);
    const int given = int(values[0].has_value()) + values[1].has_value() + values[2].has_value();
    if (given == 0) return parent;
    if (given < 3) {
      error(code.column, "the entity has " + std::to_string(given) +
                             " of 3 coordinates, expected XX, YY and ZZ or none of them");
      return parent;
    }
    if (parent < 0 && !nodes_.empty())
      error(code.column, "the entity is a second root, expected it to hang from the first");
    SkeletonNode node;
    node.parent = parent;
    node.position = Vec3(*values[0], *values[1], *values[2]) / 1000.0;
    node.diameter = number(cells, diameter_);
    if (node.diameter && *node.diameter < 0.0)
      error(cells[diameter_].column,
            "TopDia is \"" + std::string(cells[diameter_].text) + "\", expected a number >= 0");
    if (node.diameter) *node.diameter /= 10000.0;
    node.branch = code.text.find('+') != std::string_view::npos;
    node.code = code.text;
    node.where = {file_, line_, code.column};
    nodes_.push_back(std::move(node));
    return static_cast<int>(nodes_.size()) - 1;
  }

  std::optional<double> number(const std::vector<TextCell>& cells, int column) {
    if (column < 0 || column >= static_cast<int>(cells.size())) return std::nullopt;
    const TextCell& cell = cells[column];
    if (cell.text.empty()) return std::nullopt;
    const std::optional<double> value = cell_number(cell.text);
    if (!value) error(cell.column, "\"" + std::string(cell.text) + "\", expected a number");
    return value ? value : 0.0;
  }

  std::string file_;
  Diagnostics& diagnostics_;
  int line_ = 0;
  bool refused_header_ = false;
  int code_columns_ = 0;
  int coordinates_[3] = {-1, -1, -1};
  int diameter_ = -1;
  std::vector<int> depth_;  ///< of the last entity in each column: its digitised node, or -1
  std::vector<SkeletonNode> nodes_;
};

}  // namespace

std::vector<SkeletonNode> parse_mtg(const std::string& text, const std::string& file,
                                    Diagnostics& diagnostics) {
  return MtgParser(file, diagnostics).parse(text);
}

std::optional<PlantFile> read_mtg(const std::filesystem::path& path, const MtgOptions& options,
                                  Diagnostics& diagnostics) {
  try {
    const auto nodes = parse_mtg(io::read_file(path), path.string(), diagnostics);
    return checked_skeleton_plant(nodes, path.stem().string(), options, diagnostics);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
}

}  // namespace pedicel::plant
