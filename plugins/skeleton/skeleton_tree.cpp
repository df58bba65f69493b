#include "plugins/skeleton/skeleton_tree.h"

#include <unordered_map>

namespace pedicel::plant {

namespace {

class Builder {
 public:
  Builder(const std::vector<SkeletonRow>& rows, Diagnostics& diagnostics)
      : rows_(rows), diagnostics_(diagnostics) {}

  SkeletonTree build() {
    const int before = diagnostics_.error_count();
    take_ids();
    if (diagnostics_.error_count() > before) return {};
    find_parents();
    if (diagnostics_.error_count() > before) return {};
    sort();
    if (diagnostics_.error_count() > before) return {};
    return std::move(tree_);
  }

 private:
  void error(const char* kind, std::size_t row, const std::string& what) {
    diagnostics_.repeated_error(kind, rows_[row].where, what);
  }

  void take_ids() {
    row_of_.reserve(rows_.size());
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const auto [there, is_new] = row_of_.emplace(*rows_[r].id, static_cast<int>(r));
      if (is_new) continue;
      error("twice", r,
            "node " + std::to_string(*rows_[r].id) +
                " appears twice, expected it once (first in line " +
                std::to_string(rows_[there->second].where.line) + ")");
    }
  }

  // -1 is how many programs say that there is none, unless a node is called so.
  bool says_none(const SkeletonRow& row) const {
    if (!row.parent || *row.parent == *row.id) return true;
    return *row.parent == -1 && !row_of_.contains(-1);
  }

  void find_parents() {
    tree_.parent.assign(rows_.size(), -1);
    std::vector<std::size_t> roots, lost;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (says_none(rows_[r])) {
        roots.push_back(r);
        continue;
      }
      const auto found = row_of_.find(*rows_[r].parent);
      if (found == row_of_.end())
        lost.push_back(r);
      else
        tree_.parent[r] = found->second;
    }
    if (roots.empty() && lost.size() == 1) roots.swap(lost);
    for (const std::size_t r : lost)
      error("lost", r,
            "parent " + std::to_string(*rows_[r].parent) +
                " is not there, expected the number of a node (of one row alone it would mean the "
                "root)");
    for (std::size_t i = 1; i < roots.size(); ++i)
      error("root", roots[i],
            "a second root, expected one row without a parent (the first is in line " +
                std::to_string(rows_[roots[0]].where.line) + ")");
    if (roots.empty() && lost.empty())
      error("ring", 0,
            "node " + std::to_string(*rows_[0].id) +
                " is its own ancestor, expected parents that lead to the root (no row is without "
                "one)");
    if (!roots.empty()) root_ = static_cast<int>(roots.front());
  }

  void sort() {
    std::vector<std::vector<int>> children(rows_.size());
    for (int r = static_cast<int>(rows_.size()) - 1; r >= 0; --r)
      if (tree_.parent[r] >= 0) children[tree_.parent[r]].push_back(r);
    std::vector<bool> placed(rows_.size(), false);
    std::vector<int> waiting = {root_};
    while (!waiting.empty()) {
      const int row = waiting.back();
      waiting.pop_back();
      placed[row] = true;
      tree_.order.push_back(row);
      waiting.insert(waiting.end(), children[row].begin(), children[row].end());
    }
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (!placed[r])
        error("ring", r,
              "node " + std::to_string(*rows_[r].id) +
                  " is its own ancestor or hangs from one, expected parents that lead to the root");
  }

  const std::vector<SkeletonRow>& rows_;
  Diagnostics& diagnostics_;
  std::unordered_map<std::int64_t, int> row_of_;
  SkeletonTree tree_;
  int root_ = -1;
};

}  // namespace

SkeletonTree skeleton_tree(const std::vector<SkeletonRow>& rows, Diagnostics& diagnostics) {
  return Builder(rows, diagnostics).build();
}

}  // namespace pedicel::plant
