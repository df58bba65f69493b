#include "plugins/skeleton/skeleton_graph.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace pedicel::plant {

namespace {

class TreeOfGraph {
 public:
  TreeOfGraph(const SkeletonGraph& graph, Diagnostics& diagnostics)
      : graph_(graph), diagnostics_(diagnostics) {}

  std::vector<SkeletonNode> tree() {
    merge_places();
    if (!take_edges()) return {};
    root_ = find_root();
    walk();
    return nodes();
  }

 private:
  struct Link {
    int to = 0, edge = 0;
  };

  std::size_t count() const { return graph_.places.size(); }
  const Vec3& at(int place) const { return graph_.places[place].position; }

  // The first of those at the same coordinates stands for all of them.
  void merge_places() {
    std::vector<int> order(count());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int place) {
      return std::make_tuple(at(place).x(), at(place).y(), at(place).z());
    };
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return std::make_tuple(key(a), a) < std::make_tuple(key(b), b);
    });
    place_.resize(count());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
      place_[order[i]] = same ? place_[order[i - 1]] : order[i];
    }
  }

  int top(int place) {
    while (group_[place] != place) place = group_[place] = group_[group_[place]];
    return place;
  }

  bool repeats(int a, int b) const {
    return std::any_of(links_[a].begin(), links_[a].end(),
                       [&](const Link& link) { return link.to == b; });
  }

  bool take_edges() {
    const int before = diagnostics_.error_count();
    links_.resize(count());
    into_.resize(count());
    out_of_.resize(count());
    group_.resize(count());
    std::iota(group_.begin(), group_.end(), 0);
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) take_edge(static_cast<int>(e));
    if (diagnostics_.error_count() == before) check_parts();
    return diagnostics_.error_count() == before;
  }

  void take_edge(int e) {
    const SkeletonGraph::Edge& edge = graph_.edges[e];
    const int a = place_[edge.ends[0]], b = place_[edge.ends[1]];
    if (edge.ends[0] == edge.ends[1]) {
      diagnostics_.repeated_error("loop", edge.where,
                                  "edge " + std::to_string(e) + " joins vertex " +
                                      std::to_string(edge.ends[0]) +
                                      " to itself, expected two vertices");
      return;
    }
    if (a == b) return;  // of no length
    if (top(a) == top(b)) {
      const bool again = links_[a].size() < links_[b].size() ? repeats(a, b) : repeats(b, a);
      if (!again)
        diagnostics_.repeated_error(
            "ring", edge.where,
            "edge " + std::to_string(e) + " (vertices " + std::to_string(edge.ends[0]) + " and " +
                std::to_string(edge.ends[1]) + ") closes a ring, expected a tree");
      return;
    }
    group_[top(a)] = top(b);
    links_[a].push_back({b, e});
    links_[b].push_back({a, e});
    ++out_of_[a];
    ++into_[b];
  }

  void check_parts() {
    int first = -1, alone = 0;
    for (int p = 0; p < static_cast<int>(count()); ++p) {
      if (place_[p] != p) continue;
      if (links_[p].empty()) {
        ++alone;
      } else if (first < 0) {
        first = p;
      } else if (top(p) != top(first) && top(p) == p) {
        diagnostics_.repeated_error("apart", graph_.places[p].where,
                                    "vertex " + std::to_string(p) +
                                        " does not hang together with vertex " +
                                        std::to_string(first) + ", expected one tree");
      }
    }
    if (first < 0)
      diagnostics_.error({graph_.file}, "no edge has a length, expected a skeleton's edges");
    else if (alone > 0)
      diagnostics_.warning(
          {graph_.file},
          std::to_string(alone) + (alone == 1 ? " vertex without an edge is left out"
                                              : " vertices without an edge are left out"));
  }

  // The only place with edges on one side alone, where no place has two on that side; -1: none.
  int end_of_all(const std::vector<int>& side) const {
    int found = -1;
    for (int p = 0; p < static_cast<int>(count()); ++p) {
      if (place_[p] != p || links_[p].empty()) continue;
      if (side[p] > 1 || (side[p] == 0 && found >= 0)) return -1;
      if (side[p] == 0) found = p;
    }
    return found;
  }

  int lower(int a, int b) const { return at(b).z() < at(a).z() ? b : a; }

  int find_root() const {
    const int source = end_of_all(into_), sink = end_of_all(out_of_);
    if (source >= 0 && sink >= 0) return lower(source, sink);
    if (source >= 0 || sink >= 0) return std::max(source, sink);
    int lowest = -1;
    for (int p = 0; p < static_cast<int>(count()); ++p)
      if (place_[p] == p && !links_[p].empty()) lowest = lowest < 0 ? p : lower(lowest, p);
    return lowest;
  }

  // Parents first, and from the ends back the longest way beyond every place.
  void walk() {
    parent_.assign(count(), Link{-1, -1});
    order_ = {root_};
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const int p = order_[i];
      for (const Link& link : links_[p]) {
        if (link.to == parent_[p].to) continue;
        parent_[link.to] = {p, link.edge};
        order_.push_back(link.to);
      }
    }
    beyond_.assign(count(), 0.0);
    for (std::size_t i = order_.size() - 1; i > 0; --i) {
      const int p = order_[i], q = parent_[p].to;
      beyond_[q] = std::max(beyond_[q], way(p));
    }
  }

  double way(int place) const {
    return beyond_[place] + (at(place) - at(parent_[place].to)).norm();
  }

  // Depth first, so that an axis' nodes follow each other.
  std::vector<SkeletonNode> nodes() {
    std::vector<SkeletonNode> list;
    std::vector<int> number(count(), -1), waiting = {root_};
    std::vector<bool> branch(count(), false);
    while (!waiting.empty()) {
      const int p = waiting.back();
      waiting.pop_back();
      number[p] = static_cast<int>(list.size());
      SkeletonNode node = graph_.places[p];
      node.parent = p == root_ ? -1 : number[parent_[p].to];
      node.branch = branch[p];
      if (!node.diameter && p != root_) node.diameter = graph_.edges[parent_[p].edge].diameter;
      list.push_back(std::move(node));
      std::vector<int> children;
      for (const Link& link : links_[p])
        if (link.to != parent_[p].to) children.push_back(link.to);
      std::stable_sort(children.begin(), children.end(),
                       [&](int a, int b) { return way(a) > way(b); });
      for (std::size_t c = children.size(); c-- > 0;) {
        branch[children[c]] = c > 0;
        waiting.push_back(children[c]);
      }
    }
    return list;
  }

  const SkeletonGraph& graph_;
  Diagnostics& diagnostics_;
  std::vector<int> place_;  ///< which place stands for each
  std::vector<std::vector<Link>> links_;
  std::vector<int> into_, out_of_;  ///< how many edges end and begin at each
  std::vector<int> group_;          ///< of places that hang together
  std::vector<Link> parent_;
  std::vector<int> order_;
  std::vector<double> beyond_;  ///< m
  int root_ = -1;
};

}  // namespace

std::vector<SkeletonNode> rooted_tree(const SkeletonGraph& graph, Diagnostics& diagnostics) {
  return TreeOfGraph(graph, diagnostics).tree();
}

}  // namespace pedicel::plant
