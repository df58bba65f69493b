#include "plugins/plant/plant_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/stop.h"
#include "engine/geometry/curve_distance.h"
#include "engine/io/csv.h"
#include "plugins/plant/point_grid.h"

namespace pedicel::plant {

namespace {

constexpr double same_place = 1.0e-6;  // m: below it two samples are one node
/// Nodes of a plant: at 1.45 kB an element a quarter of a million take some 0.4 GB in the solver.
/// Measured while it is built: a dense random tree of 20,000 nodes takes 1 s of processor time, one
/// of 100,000 takes 10 s and 0.11 GB.
constexpr double most_nodes = 250'000;
/// Samples of a plant, some 100 bytes each: eight for each node that it may have.
constexpr double most_samples = 8.0 * most_nodes;

std::string millimetres(double metres) {
  return io::format_number(1.0e3 * metres, 4) + " mm";
}

/// Counts nodes and samples before any is made.
class SizeCheck {
 public:
  SizeCheck(const PlantFile& plant, const std::vector<geometry::Curve>& curves,
            Diagnostics& diagnostics)
      : plant_(plant), curves_(curves), diagnostics_(diagnostics) {}

  /// False, and an error, where there would be too many. `step` is that of the samples (m).
  bool run(double step) {
    const double nodes = count(plant_.distance), samples = count(step);
    // Written so that a length that is no number is refused, too.
    if (!(nodes <= most_nodes)) {
      report_nodes(nodes);
    } else if (!(samples <= most_samples)) {
      report_samples(samples, step);
    }
    return nodes <= most_nodes && samples <= most_samples;
  }

 private:
  double count(double spacing) const {
    double sum = 0.0;
    for (const geometry::Curve& curve : curves_) sum += 1.0 + curve.length() / spacing;
    return sum;
  }

  void report_nodes(double nodes) {
    std::size_t largest = 0;
    for (std::size_t c = 1; c < curves_.size(); ++c)
      if (!(curves_[c].length() <= curves_[largest].length())) largest = c;
    const double length = curves_[largest].length();
    const std::string all =
        curves_.size() == 1 ? "" : ", the plant " + io::format_number(nodes, 2) + " in all";
    diagnostics_.error(plant_.curves[largest].where,
                       "curve \"" + plant_.curves[largest].name + "\" would take " +
                           io::format_number(length / plant_.distance, 2) +
                           " nodes at sampling.distance " + io::format_number(plant_.distance, 4) +
                           " m (it is " + io::format_number(length, 4) + " m long)" + all +
                           ": expected at most " + io::format_number(most_nodes) +
                           " nodes in a plant");
  }

  void report_samples(double samples, double step) {
    diagnostics_.error(plant_.where, "plant \"" + plant_.name + "\" would be sampled at " +
                                         io::format_number(samples, 2) + " places, " +
                                         millimetres(step) + " apart, at sampling.connect " +
                                         millimetres(plant_.connect) + " and sampling.distance " +
                                         millimetres(plant_.distance) + ": expected at most " +
                                         io::format_number(most_samples) +
                                         " (larger ones, or fewer curves that nearly touch)");
  }

  const PlantFile& plant_;
  const std::vector<geometry::Curve>& curves_;
  Diagnostics& diagnostics_;
};

class Connector {
 public:
  Connector(const PlantFile& plant, const std::vector<geometry::Curve>& curves, double step,
            double junction)
      : plant_(plant),
        curves_(curves),
        junction_(junction),
        bulge_(0.5 * step + same_place),
        joined_(curves.size(), false),
        nodes_(plant.connect),
        samples_(plant.connect + bulge_) {
    if (junction > 0.0) add_boxes(step);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      throw_if_stopped();
      arcs_.push_back(samples(c, step));
      first_sample_.push_back(samples_.size());
      for (const double arc : arcs_.back()) samples_.add(curves[c].point(arc));
      curve_of_.resize(static_cast<std::size_t>(samples_.size()), static_cast<int>(c));
    }
    graph_.start_arc.assign(curves.size(), 0.0);
  }

  std::optional<PlantGraph> run(Diagnostics& diagnostics) {
    add_root();
    while (join_one_level()) {
    }
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (!joined_[c]) report(c, diagnostics);
    if (diagnostics.has_errors()) return std::nullopt;
    mark_leaves();
    mark_junctions();
    return std::move(graph_);
  }

 private:
  struct Join {
    int curve = -1;
    bool at_end = false;  // its last point is the one that joins
    int node = -1;
    double distance = std::numeric_limits<double>::infinity();  // m
  };

  void add_boxes(double step) {
    for (const geometry::Curve& curve : curves_) {
      throw_if_stopped();
      Eigen::AlignedBox3d box;
      for (const double arc : curve.sample_arcs(step)) box.extend(curve.point(arc));
      const Vec3 margin = Vec3::Constant(bulge_);
      boxes_.emplace_back(box.min() - margin, box.max() + margin);
    }
  }

  std::vector<double> samples(std::size_t curve, double step) const {
    std::vector<double> arcs = curves_[curve].sample_arcs(step);
    for (const PlantLeaf& leaf : plant_.leaves)
      if (plant_.curve_index(leaf.place.curve) == static_cast<int>(curve))
        arcs.push_back(leaf.place.at * curves_[curve].length());
    if (junction_ > 0.0) add_feet(curve, arcs);
    std::sort(arcs.begin(), arcs.end());
    const auto same = [](double a, double b) { return b - a < same_place; };
    arcs.erase(std::unique(arcs.begin(), arcs.end(), same), arcs.end());
    return arcs;
  }

  // Where other curves may be joined to this one, and the places beside.
  void add_feet(std::size_t curve, std::vector<double>& arcs) const {
    for (std::size_t other = 0; other < curves_.size(); ++other)
      for (const bool at_end : {false, true}) {
        if (other == curve) continue;
        const Vec3 end = end_of(other, at_end);
        if (boxes_[curve].exteriorDistance(end) >= plant_.connect) continue;
        throw_if_stopped();
        const auto foot = geometry::closest_on_curve(curves_[curve], end);
        if (foot.distance >= plant_.connect) continue;
        for (const double arc : {foot.arc - junction_, foot.arc, foot.arc + junction_})
          if (arc > 0.0 && arc < curves_[curve].length()) arcs.push_back(arc);
      }
  }

  Vec3 end_of(std::size_t curve, bool at_end) const {
    return curves_[curve].point(at_end ? curves_[curve].length() : 0.0);
  }

  void add_root() {
    Join root;
    for (std::size_t c = 0; c < curves_.size(); ++c)
      for (const bool at_end : {false, true}) {
        const double distance = (end_of(c, at_end) - plant_.root).norm();
        if (distance < root.distance) root = {static_cast<int>(c), at_end, -1, distance};
      }
    lay(root);
  }

  // Appends a curve's samples, from the joined end to the free one.
  void lay(const Join& join) {
    const std::vector<double>& arcs = arcs_[join.curve];
    graph_.start_arc[join.curve] = join.at_end ? arcs.back() : arcs.front();
    int parent = join.node;
    // Also where a curve goes on from another's end: an element has the section of one curve.
    if (parent >= 0) graph_.nodes[parent].carries = true;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      throw_if_stopped();
      const std::size_t sample = join.at_end ? arcs.size() - 1 - k : k;
      GraphNode node;
      node.position = samples_[first_sample_[join.curve] + static_cast<int>(sample)];
      if (k == 0 && parent >= 0 &&
          (graph_.nodes[parent].position - node.position).norm() < same_place)
        continue;
      node.curve = join.curve;
      node.arc = arcs[sample];
      node.parent = parent;
      const int index = static_cast<int>(graph_.nodes.size());
      if (parent >= 0) graph_.nodes[parent].children.push_back(index);
      nodes_.add(node.position);
      graph_.nodes.push_back(std::move(node));
      parent = index;
    }
    joined_[join.curve] = true;
  }

  // The node of the tree that either end of a curve is joined to, if one is near enough.
  std::optional<Join> join_of(std::size_t curve) const {
    throw_if_stopped();
    Join best;
    for (const bool at_end : {false, true}) {
      const PointGrid::Nearest nearest = nodes_.nearest(end_of(curve, at_end));
      if (nearest.point >= 0 && nearest.distance < best.distance)
        best = {static_cast<int>(curve), at_end, nearest.point, nearest.distance};
    }
    if (best.node < 0) return std::nullopt;
    return best;
  }

  // How far the nearer end of a curve is from the tree (m), however far.
  double distance_to_tree(std::size_t curve) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const bool at_end : {false, true})
      for (int n = 0; n < nodes_.size(); ++n)
        nearest = std::min(nearest, (nodes_[n] - end_of(curve, at_end)).norm());
    return nearest;
  }

  // Whether an end of `curve` comes nearer than `distance` to a curve that is not in the tree yet.
  // The samples tell of most curves: no point of a curve is farther than `bulge_` from one.
  bool is_nearer_to_waiting(std::size_t curve, bool at_end, double distance) {
    if (distance <= 0.0) return false;
    const Vec3 end = end_of(curve, at_end);
    near_.clear();
    samples_.for_each_near(end, [&](int sample) {
      const int c = curve_of_[static_cast<std::size_t>(sample)];
      if (c == static_cast<int>(curve) || joined_[c]) return;
      const double apart = (samples_[sample] - end).norm();
      if (apart - bulge_ < distance) near_.emplace_back(apart, c);
    });
    std::sort(near_.begin(), near_.end());  // where the answer is yes, it comes soon
    looked_at_.clear();
    for (const auto& [apart, c] : near_) {
      if (apart < 0.5 * distance) return true;
      if (std::ranges::find(looked_at_, c) != looked_at_.end()) continue;
      looked_at_.push_back(c);
      if (geometry::closest_on_curve(curves_[c], end).distance < distance) return true;
    }
    return false;
  }

  // A curve waits where the curve next to it is nearer but not in the tree yet; when all wait for
  // each other, the nearest of them goes first.
  bool join_one_level() {
    std::vector<Join> now;
    Join waiting;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      if (joined_[c]) continue;
      const std::optional<Join> join = join_of(c);
      if (!join) continue;
      if (!is_nearer_to_waiting(c, join->at_end, join->distance - same_place))
        now.push_back(*join);
      else if (join->distance < waiting.distance)
        waiting = *join;
    }
    if (now.empty() && waiting.curve >= 0) now.push_back(waiting);
    for (const Join& join : now) lay(join);
    return !now.empty();
  }

  void report(std::size_t curve, Diagnostics& diagnostics) const {
    diagnostics.error(
        plant_.curves[curve].where,
        "curve \"" + plant_.curves[curve].name + "\" reaches nothing: its nearer end is " +
            millimetres(distance_to_tree(curve)) +
            " from the plant, expected less than connect = " + millimetres(plant_.connect));
  }

  void mark_leaves() {
    for (const PlantLeaf& leaf : plant_.leaves) {
      const int curve = plant_.curve_index(leaf.place.curve);
      const double arc = leaf.place.at * curves_[curve].length();
      for (GraphNode& node : graph_.nodes)
        if (node.curve == curve && std::abs(node.arc - arc) <= same_place) node.carries = true;
    }
  }

  void mark_junctions() {
    for (const GraphNode& node : graph_.nodes) {
      if (node.children.size() < 2 || node.parent < 0) continue;
      GraphNode& below = graph_.nodes[node.parent];
      if ((node.position - below.position).norm() < 1.5 * junction_) below.carries = true;
    }
  }

  const PlantFile& plant_;
  const std::vector<geometry::Curve>& curves_;
  double junction_, bulge_;                 // m
  std::vector<Eigen::AlignedBox3d> boxes_;  // m, P, around each curve; where there are junctions
  std::vector<std::vector<double>> arcs_;
  std::vector<char> joined_;
  PointGrid nodes_;                           // of graph_
  PointGrid samples_;                         // of all curves, one after the other, at arcs_
  std::vector<int> first_sample_;             // of each curve
  std::vector<int> curve_of_;                 // of each sample
  std::vector<std::pair<double, int>> near_;  // of is_nearer_to_waiting()
  std::vector<int> looked_at_;                // likewise
  PlantGraph graph_;
};

}  // namespace

std::vector<geometry::Curve> make_curves(const PlantFile& plant) {
  std::vector<geometry::Curve> curves;
  for (const PlantCurve& curve : plant.curves) {
    std::vector<double> radii = curve.radius;
    if (radii.empty()) radii = {0.5 * std::min(curve.section.width, curve.section.height)};
    if (radii.size() == 1) radii.assign(curve.points.size(), radii.front());
    curves.push_back(curve.interpolation == Interpolation::linear
                         ? geometry::Curve::linear(curve.points, radii)
                         : geometry::Curve::smooth(curve.points, radii));
  }
  return curves;
}

double sampling_step(const std::vector<geometry::Curve>& curves, double connect, double distance) {
  const double floor = 0.25 * std::min(connect, distance);
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curves.size(); ++i) {
    throw_if_stopped();
    for (std::size_t j = 0; j < i && 0.99 * closest > floor; ++j)
      closest = std::min(closest, geometry::closest_on_curves(curves[i], curves[j]).distance);
  }
  return std::clamp(0.99 * closest, floor, std::max(floor, 0.25 * distance));
}

double PlantGraph::kept_length() const {
  double sum = 0.0;
  for (std::size_t n = 1; n < nodes.size(); ++n)
    if (nodes[n].kept)
      sum += (nodes[n].position - nodes[kept_parent(static_cast<int>(n))].position).norm();
  return sum;
}

int PlantGraph::kept_parent(int node) const {
  int parent = nodes[node].parent;
  while (parent >= 0 && !nodes[parent].kept) parent = nodes[parent].parent;
  return parent;
}

std::optional<PlantGraph> connect(const PlantFile& plant,
                                  const std::vector<geometry::Curve>& curves,
                                  Diagnostics& diagnostics, double junction) {
  const double step = sampling_step(curves, plant.connect, plant.distance);
  if (!SizeCheck(plant, curves, diagnostics).run(step)) return std::nullopt;
  return Connector(plant, curves, step, junction).run(diagnostics);
}

void simplify(PlantGraph& graph, double distance) {
  std::vector<double> since(graph.nodes.size(), 0.0);  // m, along the path from the last kept node
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
    GraphNode& node = graph.nodes[n];
    node.kept = node.is_key();
    if (node.parent < 0) continue;
    const GraphNode& parent = graph.nodes[node.parent];
    since[n] = (parent.kept ? 0.0 : since[node.parent]) + (node.position - parent.position).norm();
    if (!node.kept) {
      node.kept = since[n] >= distance * (1.0 - 1.0e-9);
      continue;
    }
    const int above = graph.kept_parent(static_cast<int>(n));
    if (!graph.nodes[above].is_key() && since[n] < 0.5 * distance) graph.nodes[above].kept = false;
  }
}

}  // namespace pedicel::plant
