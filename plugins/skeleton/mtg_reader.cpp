#include "pedicel/skeleton/mtg_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "pedicel/io/number_text.h"
#include "pedicel/io/table_dialect.h"
#include "pedicel/io/table_text.h"
#include "pedicel/io/text_file.h"
#include "pedicel/io/unit_text.h"
#include "pedicel/skeleton/text_cells.h"

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

constexpr std::size_t most_nodes = 1000000;

// "UNIT: cm" above the section MTG, or the same in a comment.
std::string stated_unit(std::string_view line) {
  return io::unit_in_comment(line.starts_with('#') ? line : "# " + std::string(line));
}

class MtgParser {
 public:
  MtgParser(std::string file, Diagnostics& diagnostics, double unit)
      : file_(std::move(file)), diagnostics_(diagnostics), asked_(unit), unit_(unit) {}

  std::vector<SkeletonNode> parse(std::string_view text) {
    const int before = diagnostics_.error_count();
    bool in_mtg = false;
    while (!text.empty() && !refused_header_) {
      const std::string_view line = take_line(text);
      ++line_;
      const std::size_t first = line.find_first_not_of(" \t");
      if (first == std::string_view::npos) continue;
      if (code_columns_ == 0) take_unit(line.substr(first));
      if (line[first] == '#') continue;
      const std::vector<TextCell> cells = split_cells(line, '\t');
      if (!in_mtg)
        in_mtg = cells.front().text.starts_with("MTG");
      else if (code_columns_ == 0)
        take_header(cells, text);
      else if (!take_entity(cells))
        break;
    }
    if (diagnostics_.error_count() == before) check_whole(in_mtg);
    if (diagnostics_.error_count() > before) nodes_.clear();
    return std::move(nodes_);
  }

 private:
  void error(int column, std::string what) {
    diagnostics_.error({file_, line_, column}, std::move(what));
  }

  // A fault of an entity, of a kind that the others may have, too.
  void entity_error(const char* kind, int column, const std::string& what) {
    diagnostics_.repeated_error(kind, {file_, line_, column}, what);
  }

  void check_whole(bool in_mtg) {
    if (!in_mtg)
      error(1, "no line \"MTG:\", expected an MTG text with that section");
    else if (code_columns_ == 0)
      error(1, "no line \"ENTITY-CODE\" after \"MTG:\", expected the names of the columns");
    else if (nodes_.empty())
      error(1, "no entity has coordinates, expected XX, YY and ZZ");
  }

  void take_unit(std::string_view line) {
    const std::string text = stated_unit(line);
    if (text.empty()) return;
    const std::optional<double> unit = io::length_unit(text);
    if (!unit)
      error(1, "unit is " + in_quotes(text) + ", expected " + io::expected_length_units());
    else if (asked_ > 0.0 && asked_ != *unit)
      error(1, "the file says that it is in " + io::length_unit_name(*unit) + ", and " +
                   io::length_unit_name(asked_) + " was asked for: expected one of them");
    else
      unit_ = *unit;
  }

  // AMAPmod's older files say TOPO.
  void take_header(const std::vector<TextCell>& cells, std::string_view rest) {
    refused_header_ = true;
    if (cells.front().text != "ENTITY-CODE" && cells.front().text != "TOPO") {
      error(cells.front().column, in_quotes(cells.front().text) +
                                      ", expected ENTITY-CODE (or TOPO) and the names of the "
                                      "columns");
      return;
    }
    const auto is_named = [](const TextCell& cell) { return !cell.text.empty(); };
    const auto named = std::find_if(cells.begin() + 1, cells.end(), is_named);
    std::string names;
    for (auto cell = named; cell != cells.end(); ++cell)
      if (is_named(*cell)) names += (names.empty() ? "" : ", ") + std::string(cell->text);
    const auto column_of = [&](std::string_view name) {
      const auto same = [&](const TextCell& cell) {
        return io::same_but_case(io::split_unit(cell.text).name, name);
      };
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
                                      ", expected the coordinates XX, YY and ZZ");
    if (refused_header_) return;
    code_columns_ = static_cast<int>(named - cells.begin());
    for (const TextCell& cell : cells) names_.emplace_back(cell.text);
    for (int i = 0; i < 3; ++i) scale_[i] = column_unit(cells[coordinates_[i]]);
    find_diameter(cells, column_of);
    find_decimal(rest);
  }

  // In the column's own unit where its name has one: "XX (cm)".
  double column_unit(const TextCell& cell) {
    const std::string text = io::split_unit(cell.text).unit;
    if (text.empty()) return unit_ > 0.0 ? unit_ : 0.001;
    const auto unit = io::unit_of(text);
    if (!unit || unit->quantity != io::Quantity::length)
      error(cell.column, "column " + in_quotes(cell.text) + " is in " + in_quotes(text) +
                             ", expected " + io::units_of(io::Quantity::length));
    else if (asked_ > 0.0 && asked_ != unit->factor)
      error(cell.column, "column " + in_quotes(cell.text) + " is in " + text + ", and " +
                             io::length_unit_name(asked_) + " was asked for: expected one of them");
    return unit ? unit->factor : 1.0;
  }

  template <typename ColumnOf>
  void find_diameter(const std::vector<TextCell>& cells, const ColumnOf& column_of) {
    struct Known {
      const char* name;
      double factor;  ///< diameter over value
    };
    for (const Known& known :
         {Known{"TopDia", 0.1}, Known{"diameter", 1.0}, Known{"radius", 2.0}}) {
      if (diameter_ >= 0) return;
      diameter_ = column_of(known.name);
      if (diameter_ < 0) continue;
      const bool own_unit = !io::split_unit(cells[diameter_].text).unit.empty();
      const double factor = own_unit && known.factor < 1.0 ? 1.0 : known.factor;
      diameter_scale_ = factor * column_unit(cells[diameter_]);
    }
  }

  void find_decimal(std::string_view rest) {
    const io::DecimalFound found = io::find_decimal(rest, line_ + 1, '\t');
    style_.decimal = found.decimal;
    if (found.fault.empty()) return;
    diagnostics_.error({file_, found.line, found.column}, found.fault);
    refused_header_ = true;
  }

  // False where there are too many.
  bool take_entity(const std::vector<TextCell>& cells) {
    if (nodes_.size() == most_nodes) {
      error(1, "the file goes on, expected at most " + std::to_string(most_nodes) + " nodes");
      return false;
    }
    take_one(cells);
    return true;
  }

  void take_one(const std::vector<TextCell>& cells) {
    int column = -1;
    for (int i = 0; i < std::min(code_columns_, static_cast<int>(cells.size())); ++i) {
      if (cells[i].text.empty()) continue;
      if (column >= 0) {
        entity_error("second", cells[i].column, "a second entity in the line, expected one");
        return;
      }
      column = i;
    }
    if (column < 0) {
      entity_error("none", 1,
                   "no entity in the line, expected one in the first " +
                       std::to_string(code_columns_) + " columns");
      return;
    }
    const TextCell& code = cells[column];
    if (!is_code(code.text))
      error(code.column,
            in_quotes(code.text) + ", expected an entity such as ^<E2, +B95/E1 or /E1<<E5");
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
    entity_error("above", code.column,
                 follows ? "\"^\" follows nothing, expected an entity above it in the same column"
                         : "the entity hangs from nothing, expected one in the column before it");
    return -1;
  }

  int add_node(const std::vector<TextCell>& cells, const TextCell& code, int parent) {
    std::optional<double> values[3];
    for (int i = 0; i < 3; ++i) values[i] = number(cells, coordinates_[i]);
    const int given = int(values[0].has_value()) + values[1].has_value() + values[2].has_value();
    if (given == 0) return parent;
    if (given < 3) {
      entity_error("coordinates", code.column,
                   "the entity has " + std::to_string(given) +
                       " of 3 coordinates, expected XX, YY and ZZ or none of them");
      return parent;
    }
    if (parent < 0 && !nodes_.empty())
      entity_error("root", code.column,
                   "the entity is a second root, expected it to hang from the first");
    SkeletonNode node;
    node.parent = parent;
    for (int i = 0; i < 3; ++i) node.position[i] = in_metres(*values[i], scale_[i]);
    node.diameter = number(cells, diameter_);
    if (node.diameter && *node.diameter < 0.0)
      entity_error("diameter", cells[diameter_].column,
                   names_[diameter_] + " is " + in_quotes(cells[diameter_].text) +
                       ", expected a number >= 0");
    if (node.diameter) node.diameter = in_metres(*node.diameter, diameter_scale_);
    node.branch = code.text.find('+') != std::string_view::npos;
    node.code = code.text;
    node.where = {file_, line_, code.column};
    nodes_.push_back(std::move(node));
    return static_cast<int>(nodes_.size()) - 1;
  }

  // Divided where the unit is a part of a metre, so that whole millimetres come to the same bits
  // as in a table in metres.
  static double in_metres(double value, double scale) {
    const double parts = std::round(1.0 / scale);
    return scale < 1.0 && std::abs(parts * scale - 1.0) < 1.0e-12 ? value / parts : value * scale;
  }

  std::optional<double> number(const std::vector<TextCell>& cells, int column) {
    if (column < 0 || column >= static_cast<int>(cells.size())) return std::nullopt;
    const TextCell& cell = cells[column];
    const io::NumberText found = io::number_of(cell.text, style_);
    if (found.kind == io::NumberText::Kind::missing) return std::nullopt;
    if (found.kind != io::NumberText::Kind::number) {
      const std::string why = io::why_no_number(cell.text, style_);
      diagnostics_.repeated_error(why, {file_, line_, cell.column},
                                  names_[column] + ": " + in_quotes(cell.text) + " " + why);
    }
    return found.value;
  }

  std::string file_;
  Diagnostics& diagnostics_;
  double asked_,
      unit_;  ///< m, of the file's lengths: by the caller, and by whoever says it; 0: none
  int line_ = 0;
  bool refused_header_ = false;
  int code_columns_ = 0;
  int coordinates_[3] = {-1, -1, -1};
  double scale_[3] = {0.001, 0.001, 0.001};  ///< m
  int diameter_ = -1;
  double diameter_scale_ = 0.0001;  ///< m
  io::NumberStyle style_;
  std::vector<std::string> names_;  ///< of the columns
  std::vector<int> depth_;  ///< of the last entity in each column: its digitised node, or -1
  std::vector<SkeletonNode> nodes_;
};

}  // namespace

std::vector<SkeletonNode> parse_mtg(const std::string& text, const std::string& file,
                                    Diagnostics& diagnostics, double unit) {
  return MtgParser(file, diagnostics, unit).parse(io::without_mark(text));
}

std::optional<PlantFile> read_mtg(const std::filesystem::path& path, const MtgOptions& options,
                                  Diagnostics& diagnostics) {
  try {
    const auto nodes =
        parse_mtg(io::read_text_file(path), path.string(), diagnostics, options.unit);
    return checked_skeleton_plant(nodes, path.stem().string(), options, diagnostics);
  } catch (const InvalidFile& fault) {
    diagnostics.add(fault);
    return std::nullopt;
  }
}

}  // namespace pedicel::plant
