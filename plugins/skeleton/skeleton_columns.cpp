#include "plugins/skeleton/skeleton_columns.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "engine/io/unit_text.h"
#include "plugins/skeleton/stated_unit.h"

namespace pedicel::plant {

namespace {

constexpr auto roles = static_cast<std::size_t>(ColumnRole::count);

struct Names {
  ColumnRole role;
  std::vector<std::string_view> texts;  ///< without capitals, blanks and separators
};

const std::vector<Names>& known_names() {
  static const std::vector<Names> names = {
      {ColumnRole::id, {"vid", "id", "nodeid", "node", "cylid", "cylinderid"}},
      {ColumnRole::parent, {"parentid", "parent", "parentnode", "parentcylinder"}},
      {ColumnRole::x, {"x", "xskeleton", "xx"}},
      {ColumnRole::y, {"y", "yskeleton", "yy"}},
      {ColumnRole::z, {"z", "zskeleton", "zz"}},
      {ColumnRole::edge, {"edgetype", "edge", "isbranch", "link"}},
      {ColumnRole::diameter, {"diameter", "diam"}},
      {ColumnRole::radius, {"radius", "radiuscyl"}},
      {ColumnRole::code, {"mtgcode"}},
      {ColumnRole::start_x, {"startx", "startpointx"}},
      {ColumnRole::start_y, {"starty", "startpointy"}},
      {ColumnRole::start_z, {"startz", "startpointz"}},
      {ColumnRole::end_x, {"endx", "endpointx"}},
      {ColumnRole::end_y, {"endy", "endpointy"}},
      {ColumnRole::end_z, {"endz", "endpointz"}},
      {ColumnRole::axis_x, {"axisx", "axisdirectionx"}},
      {ColumnRole::axis_y, {"axisy", "axisdirectiony"}},
      {ColumnRole::axis_z, {"axisz", "axisdirectionz"}},
      {ColumnRole::length, {"length"}},
      {ColumnRole::branch, {"branch", "branchid"}},
      {ColumnRole::order, {"branchorder", "branchingorder"}},
      {ColumnRole::extension, {"extension", "extensionid"}},
  };
  return names;
}

bool is_length(ColumnRole role) {
  return (role >= ColumnRole::x && role <= ColumnRole::z) || role == ColumnRole::diameter ||
         role == ColumnRole::radius || (role >= ColumnRole::start_x && role <= ColumnRole::end_z) ||
         role == ColumnRole::length;
}

std::string bare(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (std::string_view("_-. ").find(c) == std::string_view::npos)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::optional<ColumnRole> role_of(std::string_view name) {
  const std::string text = bare(name);
  for (const Names& known : known_names())
    if (std::ranges::find(known.texts, text) != known.texts.end()) return known.role;
  return std::nullopt;
}

/// What a heading says: "Start_X (mm)", "x_m".
struct Heading {
  std::optional<ColumnRole> role;
  std::string unit;
};

Heading read_heading(const std::string& text) {
  const io::NamedUnit named = io::split_unit(text);
  if (const auto role = role_of(named.name)) return {role, named.unit};
  const std::size_t last = named.name.rfind('_');
  if (last == std::string::npos || !named.unit.empty()) return {};
  const std::string unit = named.name.substr(last + 1);
  const auto role = role_of(named.name.substr(0, last));
  const auto known = io::unit_of(unit);
  if (!role || !is_length(*role) || !known || known->quantity != io::Quantity::length) return {};
  return {role, unit};
}

class Finder {
 public:
  Finder(const io::TableText& table, double unit, Diagnostics& diagnostics)
      : table_(table), unit_(unit, table.file(), diagnostics), diagnostics_(diagnostics) {
    columns_.at.fill(-1);
    columns_.unit.fill(1.0);
  }

  SkeletonColumns find() {
    const int before = diagnostics_.error_count();
    unit_.take(table_.stated_unit().text, table_.stated_unit().line);
    for (std::size_t c = 0; c < table_.columns().size(); ++c) take(static_cast<int>(c));
    const bool cylinders = columns_.has(ColumnRole::start_x) || columns_.has(ColumnRole::start_y) ||
                           columns_.has(ColumnRole::start_z);
    columns_.kind = cylinders ? SkeletonColumns::Kind::cylinders : SkeletonColumns::Kind::nodes;
    const std::string missing = cylinders ? missing_of_cylinders() : missing_of_nodes();
    if (!missing.empty())
      error(0, "a column is missing (" + missing + "), expected " +
                   (cylinders ? "id,parent_id,start_x,start_y,start_z,end_x,end_y,end_z,radius"
                              : "x,y,z,parentid,vid,edgetype or id,parent,x_m,y_m,z_m,is_branch, "
                                "or cylinders with start_x, end_x, ..., radius, id and parent_id"));
    if (diagnostics_.error_count() > before) {
      columns_.kind = SkeletonColumns::Kind::none;
      return columns_;
    }
    say_what_is_left();
    return columns_;
  }

 private:
  void error(int column, const std::string& what) {
    diagnostics_.error({table_.file(), table_.header_line(), at(column)}, what);
  }
  int at(int column) const { return table_.columns()[column].column; }

  void take(int column) {
    const io::TableColumn& source = table_.columns()[column];
    const Heading heading = read_heading(source.name);
    if (!heading.role) return;
    int& place = columns_.at[static_cast<std::size_t>(*heading.role)];
    if (place >= 0) {
      error(column, "column " + in_quotes(source.name) + " says the same as " +
                        in_quotes(table_.columns()[place].name) + ", expected one of them");
      return;
    }
    place = column;
    if (!is_length(*heading.role)) return;
    columns_.unit[static_cast<std::size_t>(*heading.role)] =
        unit_.of_column(source.name, heading.unit.empty() ? source.unit : heading.unit,
                        {table_.file(), table_.header_line(), source.column});
  }

  std::string missing(std::initializer_list<std::pair<ColumnRole, const char*>> needed) const {
    std::string list;
    for (const auto& [role, name] : needed)
      if (!columns_.has(role)) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
  }

  std::string missing_of_nodes() const {
    return missing({{ColumnRole::x, "x"},
                    {ColumnRole::y, "y"},
                    {ColumnRole::z, "z"},
                    {ColumnRole::parent, "parentid"},
                    {ColumnRole::id, "vid"}});
  }

  // An end, or an axis and a length. Rows without an id are counted from 1, as TreeQSM does.
  std::string missing_of_cylinders() const {
    std::string list = missing({{ColumnRole::parent, "parent_id"},
                                {ColumnRole::start_x, "start_x"},
                                {ColumnRole::start_y, "start_y"},
                                {ColumnRole::start_z, "start_z"},
                                {ColumnRole::radius, "radius"}});
    const std::string end = missing(
        {{ColumnRole::end_x, "end_x"}, {ColumnRole::end_y, "end_y"}, {ColumnRole::end_z, "end_z"}});
    const std::string axis = missing({{ColumnRole::axis_x, "axis_x"},
                                      {ColumnRole::axis_y, "axis_y"},
                                      {ColumnRole::axis_z, "axis_z"},
                                      {ColumnRole::length, "length"}});
    if (!end.empty() && !axis.empty()) list += (list.empty() ? "" : ", ") + end;
    return list;
  }

  bool is_read(ColumnRole role) const {
    const bool by_end = columns_.has(ColumnRole::end_x);
    if (columns_.kind == SkeletonColumns::Kind::nodes)
      return role <= ColumnRole::code &&
             !(role == ColumnRole::radius && columns_.has(ColumnRole::diameter));
    if (role >= ColumnRole::axis_x && role <= ColumnRole::length) return !by_end;
    if (role == ColumnRole::order) return !columns_.has(ColumnRole::branch);
    if (role == ColumnRole::extension)
      return !columns_.has(ColumnRole::branch) && !columns_.has(ColumnRole::order);
    return role == ColumnRole::id || role == ColumnRole::parent || role == ColumnRole::radius ||
           role >= ColumnRole::start_x;
  }

  void say_what_is_left() {
    constexpr std::size_t shown = 12;
    std::vector<bool> read(table_.columns().size(), false);
    for (std::size_t r = 0; r < roles; ++r)
      if (columns_.at[r] >= 0) read[columns_.at[r]] = is_read(static_cast<ColumnRole>(r));
    std::string list;
    std::size_t count = 0;
    for (std::size_t c = 0; c < read.size(); ++c) {
      if (read[c] || ++count > shown) continue;
      list += (list.empty() ? "" : ", ") + printable(table_.columns()[c].name, 40);
    }
    if (count > shown) list += " and " + std::to_string(count - shown) + " more";
    if (count > 0)
      diagnostics_.warning({table_.file(), table_.header_line(), 1},
                           "columns that are not read: " + list);
  }

  const io::TableText& table_;
  StatedLengthUnit unit_;
  Diagnostics& diagnostics_;
  SkeletonColumns columns_;
};

}  // namespace

SkeletonColumns find_skeleton_columns(const io::TableText& table, double unit,
                                      Diagnostics& diagnostics) {
  return Finder(table, unit, diagnostics).find();
}

bool looks_like_skeleton(const std::vector<std::string>& headings) {
  const auto has = [&](ColumnRole role) {
    return std::any_of(headings.begin(), headings.end(),
                       [&](const std::string& text) { return read_heading(text).role == role; });
  };
  const bool node =
      has(ColumnRole::x) && has(ColumnRole::y) && has(ColumnRole::z) && has(ColumnRole::id);
  return has(ColumnRole::parent) && (node || has(ColumnRole::start_x));
}

}  // namespace pedicel::plant
