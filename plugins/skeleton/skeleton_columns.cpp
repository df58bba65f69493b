#include "pedicel/skeleton/skeleton_columns.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "pedicel/io/csv.h"
#include "pedicel/io/unit_text.h"

namespace pedicel::plant {

namespace {

constexpr auto roles = static_cast<std::size_t>(Role::count);

struct Name {
  std::string_view text;  ///< without capitals, blanks and separators
  Role role;
};

constexpr std::array names = {
    Name{"vid", Role::id},
    Name{"id", Role::id},
    Name{"nodeid", Role::id},
    Name{"node", Role::id},
    Name{"cylid", Role::id},
    Name{"cylinderid", Role::id},
    Name{"parentid", Role::parent},
    Name{"parent", Role::parent},
    Name{"parentnode", Role::parent},
    Name{"parentcylinder", Role::parent},
    Name{"x", Role::x},
    Name{"y", Role::y},
    Name{"z", Role::z},
    Name{"xskeleton", Role::x},
    Name{"yskeleton", Role::y},
    Name{"zskeleton", Role::z},
    Name{"edgetype", Role::edge},
    Name{"edge", Role::edge},
    Name{"isbranch", Role::edge},
    Name{"diameter", Role::diameter},
    Name{"diam", Role::diameter},
    Name{"radius", Role::radius},
    Name{"radiuscyl", Role::radius},
    Name{"mtgcode", Role::code},
    Name{"startx", Role::start_x},
    Name{"starty", Role::start_y},
    Name{"startz", Role::start_z},
    Name{"startpointx", Role::start_x},
    Name{"startpointy", Role::start_y},
    Name{"startpointz", Role::start_z},
    Name{"endx", Role::end_x},
    Name{"endy", Role::end_y},
    Name{"endz", Role::end_z},
    Name{"endpointx", Role::end_x},
    Name{"endpointy", Role::end_y},
    Name{"endpointz", Role::end_z},
    Name{"axisx", Role::axis_x},
    Name{"axisy", Role::axis_y},
    Name{"axisz", Role::axis_z},
    Name{"axisdirectionx", Role::axis_x},
    Name{"axisdirectiony", Role::axis_y},
    Name{"axisdirectionz", Role::axis_z},
    Name{"length", Role::length},
    Name{"branch", Role::branch},
    Name{"branchid", Role::branch},
    Name{"branchorder", Role::order},
    Name{"branchingorder", Role::order},
    Name{"extension", Role::extension},
    Name{"extensionid", Role::extension},
};

bool is_length(Role role) {
  return (role >= Role::x && role <= Role::z) || role == Role::diameter || role == Role::radius ||
         (role >= Role::start_x && role <= Role::end_z) || role == Role::length;
}

std::string bare(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (std::string_view("_-. ").find(c) == std::string_view::npos)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::optional<Role> role_of(std::string_view name) {
  const std::string text = bare(name);
  for (const Name& known : names)
    if (known.text == text) return known.role;
  return std::nullopt;
}

/// What a heading says: "Start_X (mm)", "x_m".
struct Heading {
  std::optional<Role> role;
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
      : table_(table), asked_(unit), diagnostics_(diagnostics) {
    columns_.at.fill(-1);
    columns_.unit.fill(1.0);
  }

  SkeletonColumns find() {
    const int before = diagnostics_.error_count();
    read_stated_unit();
    for (std::size_t c = 0; c < table_.columns().size(); ++c) take(static_cast<int>(c));
    const bool cylinders =
        columns_.has(Role::start_x) || columns_.has(Role::start_y) || columns_.has(Role::start_z);
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

  void read_stated_unit() {
    const io::StatedUnit& stated = table_.stated_unit();
    whole_ = asked_ > 0.0 ? asked_ : 1.0;
    if (stated.text.empty()) return;
    const SourcePosition where{table_.file(), stated.line, 1};
    const std::optional<double> unit = io::length_unit(stated.text);
    if (!unit)
      diagnostics_.error(
          where, "unit is " + in_quotes(stated.text) + ", expected " + io::expected_length_units());
    else if (asked_ > 0.0 && asked_ != *unit)
      diagnostics_.error(where, "the file says that it is in " + io::length_unit_name(*unit) +
                                    ", and " + io::length_unit_name(asked_) +
                                    " was asked for: expected one of them");
    else
      whole_ = *unit;
  }

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
        unit_of(column, heading.unit.empty() ? source.unit : heading.unit);
  }

  double unit_of(int column, const std::string& text) {
    if (text.empty()) return whole_;
    const auto unit = io::unit_of(text);
    if (!unit || unit->quantity != io::Quantity::length) {
      error(column, "column " + in_quotes(table_.columns()[column].name) + " is in " +
                        in_quotes(text) + ", expected " + io::units_of(io::Quantity::length));
      return 1.0;
    }
    if (asked_ > 0.0 && asked_ != unit->factor)
      error(column, "column " + in_quotes(table_.columns()[column].name) + " is in " + text +
                        ", and " + io::length_unit_name(asked_) +
                        " was asked for: expected one of them");
    return unit->factor;
  }

  std::string missing(std::initializer_list<std::pair<Role, const char*>> needed) const {
    std::string list;
    for (const auto& [role, name] : needed)
      if (!columns_.has(role)) list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
  }

  std::string missing_of_nodes() const {
    return missing({{Role::x, "x"},
                    {Role::y, "y"},
                    {Role::z, "z"},
                    {Role::parent, "parentid"},
                    {Role::id, "vid"},
                    {Role::edge, "edgetype"}});
  }

  // An end, or an axis and a length. Rows without an id are counted from 1, as TreeQSM does.
  std::string missing_of_cylinders() const {
    std::string list = missing({{Role::parent, "parent_id"},
                                {Role::start_x, "start_x"},
                                {Role::start_y, "start_y"},
                                {Role::start_z, "start_z"},
                                {Role::radius, "radius"}});
    const std::string end =
        missing({{Role::end_x, "end_x"}, {Role::end_y, "end_y"}, {Role::end_z, "end_z"}});
    const std::string axis = missing({{Role::axis_x, "axis_x"},
                                      {Role::axis_y, "axis_y"},
                                      {Role::axis_z, "axis_z"},
                                      {Role::length, "length"}});
    if (!end.empty() && !axis.empty()) list += (list.empty() ? "" : ", ") + end;
    return list;
  }

  bool is_read(Role role) const {
    const bool by_end = columns_.has(Role::end_x);
    if (columns_.kind == SkeletonColumns::Kind::nodes)
      return role <= Role::code && !(role == Role::radius && columns_.has(Role::diameter));
    if (role >= Role::axis_x && role <= Role::length) return !by_end;
    if (role == Role::order) return !columns_.has(Role::branch);
    if (role == Role::extension) return !columns_.has(Role::branch) && !columns_.has(Role::order);
    return role == Role::id || role == Role::parent || role == Role::radius ||
           role >= Role::start_x;
  }

  void say_what_is_left() {
    constexpr std::size_t shown = 12;
    std::vector<bool> read(table_.columns().size(), false);
    for (std::size_t r = 0; r < roles; ++r)
      if (columns_.at[r] >= 0) read[columns_.at[r]] = is_read(static_cast<Role>(r));
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
  double asked_, whole_ = 1.0;
  Diagnostics& diagnostics_;
  SkeletonColumns columns_;
};

}  // namespace

SkeletonColumns find_skeleton_columns(const io::TableText& table, double unit,
                                      Diagnostics& diagnostics) {
  return Finder(table, unit, diagnostics).find();
}

bool looks_like_skeleton(const std::vector<std::string>& headings) {
  const auto has = [&](Role role) {
    return std::any_of(headings.begin(), headings.end(),
                       [&](const std::string& text) { return read_heading(text).role == role; });
  };
  const bool node = has(Role::x) && has(Role::y) && has(Role::z) && has(Role::id);
  return has(Role::parent) && (node || has(Role::start_x));
}

}  // namespace pedicel::plant
