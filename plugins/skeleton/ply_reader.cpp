#include "plugins/skeleton/ply_reader.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/io/number_text.h"
#include "engine/io/table_text.h"
#include "engine/io/unit_text.h"
#include "plugins/skeleton/ply_file.h"
#include "plugins/skeleton/skeleton_graph.h"
#include "plugins/skeleton/stated_unit.h"

namespace pedicel::plant {

namespace {

constexpr std::size_t most_ply_places = 1000000;

/// Where an element has its thickness, and what a number there is in diameters.
struct Thickness {
  std::optional<std::size_t> property;
  double factor = 1.0;
};

Thickness find_thickness(const PlyElement& element) {
  if (const auto radius = element.find({"radius", "rad"})) return {radius, 2.0};
  return {element.find({"diameter", "diam"}), 1.0};
}

class PlySkeletonParser {
 public:
  PlySkeletonParser(std::string_view bytes, const std::string& file, double unit,
                    Diagnostics& diagnostics)
      : bytes_(bytes),
        file_(file),
        diagnostics_(diagnostics),
        before_(diagnostics.error_count()),
        unit_(unit, file, diagnostics) {}

  std::vector<SkeletonNode> parse() {
    const auto header = read_ply_header(bytes_, file_, diagnostics_);
    if (!header) return {};
    for (const PlyHeader::Comment& comment : header->comments)
      unit_.take(io::unit_in_comment("# " + comment.text), comment.line);
    for (const PlyHeader::Comment& comment : header->comments) take_radius(comment);
    if (!good() || !find_elements(*header) || !read(*header)) return {};
    if (!check_ends() || !check_thickness()) return {};
    graph_.file = file_;
    return rooted_tree(graph_, diagnostics_);
  }

 private:
  bool good() const { return diagnostics_.error_count() == before_; }
  bool error(int line, const std::string& what) {
    diagnostics_.error({file_, line, line > 0 ? 1 : 0}, what);
    return false;
  }

  // "radius: 0.004": of all stems, in the file's unit.
  void take_radius(const PlyHeader::Comment& comment) {
    std::string_view text = comment.text;
    const auto cut = [&text](const char* what) {
      text.remove_prefix(std::min(text.find_first_not_of(what), text.size()));
    };
    cut(" \t");
    if (!io::same_but_case(text.substr(0, 6), "radius")) return;
    text.remove_prefix(6);
    cut(" \t:=");
    text = text.substr(0, text.find_last_not_of(" \t\r") + 1);
    const io::NumberText number = io::number_of(text);
    if (number.kind != io::NumberText::Kind::number || number.value <= 0.0)
      error(comment.line, "radius is " + in_quotes(text) + ", expected a number > 0");
    else
      radius_of_all_ = number.value * unit_.metres(1.0);
  }

  bool find_elements(const PlyHeader& header) {
    vertices_ = header.find({"vertex", "vertices"});
    edges_ = header.find({"edge", "edges"});
    const PlyElement* faces = header.find({"face", "faces"});
    if (vertices_ == nullptr) return error(1, "no element vertex, expected x, y and z of places");
    if (edges_ == nullptr || edges_->count == 0)
      return error(
          1, std::string(faces != nullptr && faces->count > 0 ? "a surface (faces and no edges)"
                                                              : "a cloud of points (no edges)") +
                 ", expected a skeleton: element edge with vertex1 and vertex2");
    if (std::max(vertices_->count, edges_->count) > most_ply_places)
      return error(vertices_->line, std::to_string(vertices_->count) + " vertices and " +
                                        std::to_string(edges_->count) +
                                        " edges, expected at most " +
                                        std::to_string(most_ply_places) + " of each");
    return find_properties();
  }

  bool find_properties() {
    const char* const names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      const auto found = vertices_->find({names[i]});
      if (!found)
        return error(vertices_->line,
                     std::string("no property ") + names[i] + " of vertex, expected x, y and z");
      axis_[i] = *found;
    }
    first_ = edges_->find({"vertex1", "vertex_1", "v1", "source", "start", "from"});
    second_ = edges_->find({"vertex2", "vertex_2", "v2", "target", "end", "to"});
    list_ = edges_->find({"vertex_indices", "vertex_index", "vertices"}, true);
    if (!(first_ && second_) && !list_)
      return error(edges_->line,
                   "no properties vertex1 and vertex2 of edge, expected the numbers of its ends");
    of_vertex_ = find_thickness(*vertices_);
    of_edge_ = find_thickness(*edges_);
    if (of_vertex_.property || of_edge_.property || radius_of_all_) return true;
    return error(vertices_->line,
                 "no radius, expected a property radius or diameter of vertex or edge, or a line "
                 "\"comment radius: 0.004\" in the header (of all stems, in the file's unit)");
  }

  bool read(const PlyHeader& header) {
    PlyRows rows(bytes_, header, file_, diagnostics_);
    bool have_vertices = false, have_edges = false;
    for (const PlyElement& element : header.elements) {
      const bool vertex = &element == vertices_, edge = &element == edges_;
      have_vertices |= vertex;
      have_edges |= edge;
      if (vertex ? !read_vertices(rows) : edge ? !read_edges(rows) : !rows.skip(element))
        return false;
      if (have_vertices && have_edges) break;
    }
    return good();
  }

  std::optional<double> diameter(const Thickness& from,
                                 const std::vector<std::vector<double>>& values,
                                 const SourcePosition& where) {
    if (!from.property) return std::nullopt;
    const double value = values[*from.property].front();
    if (std::isnan(value) || value == 0.0) return std::nullopt;
    if (!std::isfinite(value) || value < 0.0)
      diagnostics_.repeated_error(
          "thickness", where,
          "a radius or diameter of " + std::to_string(value) + ", expected a number >= 0");
    return from.factor * unit_.metres(value);
  }

  bool read_vertices(PlyRows& rows) {
    if (!rows.fits(*vertices_)) return false;
    graph_.places.reserve(vertices_->count);
    std::vector<std::vector<double>> values;
    for (std::size_t v = 0; v < vertices_->count; ++v) {
      if (!rows.next(*vertices_, values)) return false;
      SkeletonNode node;
      node.where = rows.where();
      for (int i = 0; i < 3; ++i) node.position[i] = unit_.metres(values[axis_[i]].front());
      if (!node.position.allFinite())
        diagnostics_.repeated_error(
            "place", node.where,
            "vertex " + std::to_string(v) + " is nowhere, expected finite x, y and z");
      node.diameter = diameter(of_vertex_, values, node.where);
      graph_.places.push_back(std::move(node));
    }
    return good();
  }

  bool read_edges(PlyRows& rows) {
    if (!rows.fits(*edges_)) return false;
    std::vector<std::vector<double>> values;
    for (std::size_t e = 0; e < edges_->count; ++e) {
      if (!rows.next(*edges_, values)) return false;
      std::vector<double> ends;
      if (first_ && second_)
        ends = {values[*first_].front(), values[*second_].front()};
      else
        ends = values[*list_];
      const std::optional<double> wide = diameter(of_edge_, values, rows.where());
      for (std::size_t i = 1; i < ends.size(); ++i)
        if (!add_edge(ends[i - 1], ends[i], wide, rows.where())) return false;
    }
    return good();
  }

  // Edges may stand before the vertices, so that their ends are checked later.
  bool add_edge(double from, double to, const std::optional<double>& wide,
                const SourcePosition& where) {
    if (graph_.edges.size() == most_ply_places)
      return error(where.line, "the edges go on, expected at most " +
                                   std::to_string(most_ply_places) + " of them");
    const double most = static_cast<double>(vertices_->count);
    for (const double end : {from, to})
      if (!(end >= 0.0 && end < most && end == std::floor(end))) {
        diagnostics_.repeated_error("end", where,
                                    "an edge ends at vertex " + printable(text_of(end)) +
                                        ", expected a number from 0 to " + text_of(most - 1.0));
        return true;
      }
    graph_.edges.push_back({{static_cast<int>(from), static_cast<int>(to)}, wide, where});
    return true;
  }

  static std::string text_of(double number) {
    return number == std::floor(number) && std::abs(number) < 1.0e15
               ? std::to_string(static_cast<long long>(number))
               : std::to_string(number);
  }

  bool check_ends() {
    return !graph_.places.empty() || error(vertices_->line, "no vertices, expected some");
  }

  // A radius of all stems stands in for those that are missing.
  bool check_thickness() {
    const auto has = [](const auto& one) { return one.diameter.has_value(); };
    if (radius_of_all_) {
      const double wide = 2.0 * *radius_of_all_;
      for (SkeletonGraph::Edge& edge : graph_.edges) edge.diameter = edge.diameter.value_or(wide);
      if (!of_edge_.property)
        for (SkeletonNode& node : graph_.places) node.diameter = node.diameter.value_or(wide);
    }
    return std::any_of(graph_.places.begin(), graph_.places.end(), has) ||
           std::any_of(graph_.edges.begin(), graph_.edges.end(), has) ||
           error(vertices_->line, "every radius is 0 or missing, expected some above 0");
  }

  std::string_view bytes_;
  const std::string& file_;
  Diagnostics& diagnostics_;
  int before_;
  StatedLengthUnit unit_;
  const PlyElement *vertices_ = nullptr, *edges_ = nullptr;
  std::size_t axis_[3] = {0, 0, 0};
  std::optional<std::size_t> first_, second_, list_;
  Thickness of_vertex_, of_edge_;
  std::optional<double> radius_of_all_;  ///< m
  SkeletonGraph graph_;
};

}  // namespace

std::vector<SkeletonNode> parse_ply_skeleton(const std::string& bytes, const std::string& file,
                                             Diagnostics& diagnostics, double unit) {
  return PlySkeletonParser(bytes, file, unit, diagnostics).parse();
}

}  // namespace pedicel::plant
