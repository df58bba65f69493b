#include "plugins/skeleton/mtg_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

#include "engine/io/number_text.h"
#include "engine/io/table_dialect.h"
#include "engine/io/table_text.h"
#include "engine/io/text_file.h"
#include "engine/io/unit_text.h"
#include "plugins/skeleton/mtg_columns.h"
#include "plugins/skeleton/text_cells.h"

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
    const auto digits = std::find_if_not(letters, code.end(), is_digit);
    if (digits == code.begin()) return false;  // OpenAlea numbers those without a label
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
      if (columns_.codes == 0) take_unit(line.substr(first));
      if (line[first] == '#') continue;
      const std::vector<TextCell> cells = split_cells(line, '\t');
      if (!in_mtg) {
        in_mtg = cells.front().text.starts_with("MTG");
        take_class(cells);
      } else if (columns_.codes == 0) {
        take_header(cells, text);
      } else if (!take_entity(cells)) {
        break;
      }
    }
    if (diagnostics_.error_count() == before) check_whole(in_mtg);
    if (diagnostics_.error_count() > before) nodes_.clear();
    return std::move(nodes_);
  }

 private:
  /// The last entity of a column: its digitised node, or the one above it (-1: none), and whether
  /// an axis begins between the two.
  struct Above {
    int node = -1;
    bool branch = false;
    int scale = -1;  ///< of its class, -1: unknown
  };
  struct Column {
    Above above;
    std::optional<Above> carrier;  ///< of a branch without a place in the same column
  };

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
    else if (columns_.codes == 0)
      error(1, "no line \"ENTITY-CODE\" after \"MTG:\", expected the names of the columns");
    else if (nodes_.empty())
      error(1, "no entity has coordinates, expected places");
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

  void take_header(const std::vector<TextCell>& cells, std::string_view rest) {
    columns_ = find_mtg_columns(cells, asked_, unit_, {file_, line_, 1}, diagnostics_);
    refused_header_ = columns_.codes == 0;
    // Where places stand in one column, commas part their numbers.
    if (!refused_header_ && !columns_.in_one()) find_decimal(rest);
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
    for (int i = 0; i < std::min(columns_.codes, static_cast<int>(cells.size())); ++i) {
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
                       std::to_string(columns_.codes) + " columns");
      return;
    }
    const TextCell& code = cells[column];
    if (!is_code(code.text))
      error(code.column,
            in_quotes(code.text) + ", expected an entity such as ^<E2, +B95/E1 or /E1<<E5");
    Above here = add_node(cells, code, parent_of(code, column));
    here.scale = scale_of(code.text);
    // A branch that is one column with what carries it: OpenAlea writes its parts behind it.
    std::optional<Above> carrier;
    if (code.text.starts_with("^+") && here.branch && column < static_cast<int>(depth_.size()))
      carrier = depth_[column].carrier ? depth_[column].carrier : depth_[column].above;
    depth_.resize(static_cast<std::size_t>(column));
    depth_.push_back({here, carrier});
  }

  // Under CLASSES: a class and its scale.
  void take_class(const std::vector<TextCell>& cells) {
    constexpr std::size_t most_classes = 1000;
    if (cells.size() < 2 || scale_of_class_.size() == most_classes) return;
    const io::NumberText scale = io::number_of(cells[1].text);
    if (scale.kind == io::NumberText::Kind::number && scale.value >= 0.0 && scale.value < 100.0)
      scale_of_class_.emplace(cells[0].text, static_cast<int>(scale.value));
  }

  // Of the last class in a code.
  int scale_of(std::string_view code) const {
    const std::size_t relation = code.find_last_of("/<+");
    std::string_view name = relation == std::string_view::npos ? code : code.substr(relation + 1);
    name = name.substr(0, name.find_first_of("0123456789"));
    const auto found = scale_of_class_.find(name);
    return found == scale_of_class_.end() ? -1 : found->second;
  }

  // "^" means the last of the column that has the scale for it: a part follows the part that
  // carries a branch, not the branch, whose own parts begin with "/".
  Above last_of(const Column& column, bool follows, const TextCell& code) const {
    const bool part = follows && column.carrier && !code.text.starts_with("^/") &&
                      column.above.scale < column.carrier->scale;
    return part ? *column.carrier : column.above;
  }

  // The nearest digitised node above: entities without coordinates pass their own one on.
  Above parent_of(const TextCell& code, int column) {
    const bool follows = !code.text.empty() && code.text.front() == '^';
    const int above = follows ? column : column - 1;
    // The first entities are those of the whole plant; nothing is above the very first one.
    if (depth_.empty() || above < 0) return {};
    if (above < static_cast<int>(depth_.size())) return last_of(depth_[above], follows, code);
    entity_error("above", code.column,
                 follows ? "\"^\" follows nothing, expected an entity above it in the same column"
                         : "the entity hangs from nothing, expected one in the column before it");
    return {};
  }

  /// What a line says of a place: nothing, or where it is, in m.
  std::optional<Vec3> place_of(const std::vector<TextCell>& cells, const TextCell& code) {
    if (columns_.in_one()) return place_in(cells, columns_.place[0]);
    std::optional<double> values[3];
    for (int i = 0; i < 3; ++i) values[i] = number(cells, columns_.place[i]);
    const int given = int(values[0].has_value()) + values[1].has_value() + values[2].has_value();
    if (given > 0 && given < 3)
      entity_error("coordinates", code.column,
                   "the entity has " + std::to_string(given) + " of 3 coordinates, expected " +
                       columns_.names[columns_.place[0]] + ", " +
                       columns_.names[columns_.place[1]] + " and " +
                       columns_.names[columns_.place[2]] + " or none of them");
    if (given < 3) return std::nullopt;
    Vec3 place;
    for (int i = 0; i < 3; ++i) place[i] = in_metres(*values[i], columns_.scale[i]);
    return place;
  }

  std::optional<Vec3> place_in(const std::vector<TextCell>& cells, int column) {
    if (column < 0 || column >= static_cast<int>(cells.size())) return std::nullopt;
    const TextCell& cell = cells[column];
    if (io::number_of(cell.text, style_).kind == io::NumberText::Kind::missing) return std::nullopt;
    std::optional<Vec3> place = place_in_one(cell.text, style_);
    if (!place)
      entity_error("place", cell.column,
                   columns_.names[column] + ": " + in_quotes(cell.text) +
                       ", expected three numbers such as (0.1, 0.2, 0.3)");
    else
      for (int i = 0; i < 3; ++i) (*place)[i] = in_metres((*place)[i], columns_.scale[i]);
    return place;
  }

  Above add_node(const std::vector<TextCell>& cells, const TextCell& code, const Above& above) {
    const bool branch = above.branch || code.text.find('+') != std::string_view::npos;
    const std::optional<Vec3> place = place_of(cells, code);
    if (!place) return {above.node, branch};
    if (above.node < 0 && !nodes_.empty())
      entity_error("root", code.column,
                   "the entity is a second root, expected it to hang from the first");
    SkeletonNode node;
    node.parent = above.node;
    node.position = *place;
    node.diameter = number(cells, columns_.diameter);
    if (node.diameter && *node.diameter < 0.0)
      entity_error("diameter", cells[columns_.diameter].column,
                   columns_.names[columns_.diameter] + " is " +
                       in_quotes(cells[columns_.diameter].text) + ", expected a number >= 0");
    if (node.diameter) node.diameter = in_metres(*node.diameter, columns_.diameter_scale);
    node.branch = branch;
    node.code = code.text;
    node.where = {file_, line_, code.column};
    if (nodes_.empty()) add_foot(cells, node);
    nodes_.push_back(std::move(node));
    return {static_cast<int>(nodes_.size()) - 1, false};
  }

  // Where the first entity begins, if the file says so.
  void add_foot(const std::vector<TextCell>& cells, SkeletonNode& first) {
    const std::optional<Vec3> place = place_in(cells, columns_.foot);
    if (!place) return;
    SkeletonNode foot = first;
    foot.position = *place;
    nodes_.push_back(std::move(foot));
    first.parent = 0;
    first.branch = false;
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
                                  columns_.names[column] + ": " + in_quotes(cell.text) + " " + why);
    }
    return found.value;
  }

  std::string file_;
  Diagnostics& diagnostics_;
  double asked_,
      unit_;  ///< m, of the file's lengths: by the caller, and by whoever says it; 0: none
  int line_ = 0;
  bool refused_header_ = false;
  MtgColumns columns_;
  io::NumberStyle style_;
  std::vector<Column> depth_;
  std::map<std::string, int, std::less<>> scale_of_class_;
  std::vector<SkeletonNode> nodes_;
};

}  // namespace

std::vector<SkeletonNode> parse_mtg(const std::string& text, const std::string& file,
                                    Diagnostics& diagnostics, double unit) {
  return MtgParser(file, diagnostics, unit).parse(io::without_mark(text));
}

}  // namespace pedicel::plant
