#include "plugins/skeleton/mtg_columns.h"

#include <algorithm>

#include "engine/io/unit_text.h"

namespace pedicel::plant {

namespace {

class MtgHeader {
 public:
  MtgHeader(const std::vector<TextCell>& cells, const StatedLengthUnit& unit, SourcePosition line,
            Diagnostics& diagnostics)
      : cells_(cells), unit_(unit), line_(std::move(line)), diagnostics_(diagnostics) {}

  MtgColumns find() {
    const int before = diagnostics_.error_count();
    const std::string_view first = cells_.front().text;
    if (first != "ENTITY-CODE" && first != "TOPO") {
      error(cells_.front(),
            in_quotes(first) + ", expected ENTITY-CODE (or TOPO) and the names of the columns");
      return {};
    }
    const auto named = std::find_if(cells_.begin() + 1, cells_.end(),
                                    [](const TextCell& cell) { return !cell.text.empty(); });
    first_ = static_cast<int>(named - cells_.begin());
    find_place();
    find_diameter();
    if (diagnostics_.error_count() > before) return {};
    for (const TextCell& cell : cells_) columns_.names.emplace_back(cell.text);
    columns_.codes = first_;
    return std::move(columns_);
  }

 private:
  void error(const TextCell& cell, const std::string& what) {
    diagnostics_.error({line_.file, line_.line, cell.column}, what);
  }

  int column_of(std::string_view name) const {
    const auto found =
        std::find_if(cells_.begin() + first_, cells_.end(), [&](const TextCell& cell) {
          return io::same_but_case(io::split_unit(cell.text).name, name);
        });
    return found == cells_.end() ? -1 : static_cast<int>(found - cells_.begin());
  }

  std::string missing(const std::array<const char*, 3>& names) {
    std::string list;
    for (std::size_t i = 0; i < 3; ++i) {
      columns_.place[i] = column_of(names[i]);
      if (columns_.place[i] < 0) list += (list.empty() ? "" : ", ") + std::string(names[i]);
    }
    return list;
  }

  // What OpenAlea's programs call it: digitised, of PlantScan3D, or computed by a turtle.
  void find_place() {
    const std::string lacking = missing({"XX", "YY", "ZZ"});
    if (!lacking.empty() && !missing({"X", "Y", "Z"}).empty()) {
      int whole = -1;
      for (const char* name : {"TopPosition", "position"})
        if (whole < 0) whole = column_of(name);
      if (whole < 0) return say_missing(lacking);
      columns_.place = {whole, whole, whole};
      columns_.foot = column_of("BottomPosition");
    }
    for (std::size_t i = 0; i < 3; ++i) columns_.scale[i] = unit(cells_[columns_.place[i]]);
  }

  void say_missing(const std::string& lacking) {
    std::string names;
    for (std::size_t c = first_; c < cells_.size(); ++c)
      if (!cells_[c].text.empty())
        names += (names.empty() ? "" : ", ") + std::string(cells_[c].text);
    error(
        cells_.front(),
        "no column " + lacking + " beside " + (names.empty() ? "ENTITY-CODE" : names) +
            ", expected the coordinates XX, YY and ZZ, or X, Y and Z, or TopPosition (lengths and "
            "angles alone mean a different plant to every program)");
  }

  // In the column's own unit where its name has one: "XX (cm)".
  double unit(const TextCell& cell) const {
    return unit_.of_column(std::string(cell.text), io::split_unit(cell.text).unit,
                           {line_.file, line_.line, cell.column});
  }

  void find_diameter() {
    struct Known {
      const char* name;
      double factor;  ///< diameter over value
    };
    for (const Known& known : {Known{"TopDia", 0.1}, Known{"diameter", 1.0}, Known{"diam", 1.0},
                               Known{"TopDiameter", 1.0}, Known{"radius", 2.0}}) {
      columns_.diameter = column_of(known.name);
      if (columns_.diameter < 0) continue;
      const TextCell& cell = cells_[columns_.diameter];
      const bool own_unit = !io::split_unit(cell.text).unit.empty();
      const double factor = own_unit && known.factor < 1.0 ? 1.0 : known.factor;
      columns_.diameter_scale = factor * unit(cell);
      return;
    }
  }

  const std::vector<TextCell>& cells_;
  const StatedLengthUnit& unit_;
  SourcePosition line_;
  Diagnostics& diagnostics_;
  int first_ = 0;  ///< column that has a name
  MtgColumns columns_;
};

}  // namespace

MtgColumns find_mtg_columns(const std::vector<TextCell>& cells, const StatedLengthUnit& unit,
                            const SourcePosition& line, Diagnostics& diagnostics) {
  return MtgHeader(cells, unit, line, diagnostics).find();
}

std::optional<Vec3> place_in_one(std::string_view text, const io::NumberStyle& style) {
  const std::size_t open = text.find_first_of("([");
  if (open != std::string_view::npos) text.remove_prefix(open + 1);
  text = text.substr(0, text.find_first_of(")]"));
  Vec3 place;
  int count = 0;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(", ;"), text.size()));
    if (text.empty()) break;
    const std::string_view word = text.substr(0, text.find_first_of(", ;"));
    text.remove_prefix(word.size());
    const io::NumberText number = io::number_of(word, style);
    if (number.kind != io::NumberText::Kind::number || count == 3) return std::nullopt;
    place[count++] = number.value;
  }
  return count == 3 ? std::optional<Vec3>(place) : std::nullopt;
}

}  // namespace pedicel::plant
