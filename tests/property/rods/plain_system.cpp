#include "tests/property/rods/plain_system.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

namespace pedicel::plain {

namespace {

// entry(row, column, value) for the lower triangle, both halves of a pair in it.
template <class Entry>
void for_each_entry(const System& system, const Entry& entry) {
  const auto put = [&](int row, int column, const Block& block) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const int a = 6 * row + i, b = 6 * column + j;
        if (row == column ? i >= j : block(i, j) != 0.0)
          entry(std::max(a, b), std::min(a, b), block(i, j));
      }
  };
  for (int e = 0; e < system.model.size(); ++e) {
    put(e, e, system.diagonal[e]);
    const int parent = system.model.elements[e].parent;
    if (parent >= 0) put(e, parent, system.coupling[e]);
  }
  for (std::size_t w = 0; w < system.weld.size(); ++w)
    put(system.model.welds[w].b, system.model.welds[w].a, system.weld[w]);
}

Eigen::VectorXd stacked(const std::vector<Six>& parts) {
  Eigen::VectorXd all(6 * static_cast<Eigen::Index>(parts.size()));
  for (std::size_t e = 0; e < parts.size(); ++e)
    all.segment<6>(6 * static_cast<Eigen::Index>(e)) = parts[e];
  return all;
}

std::vector<Six> parted(const Eigen::VectorXd& all) {
  std::vector<Six> parts(static_cast<std::size_t>(all.size() / 6));
  for (std::size_t e = 0; e < parts.size(); ++e)
    parts[e] = all.segment<6>(6 * static_cast<Eigen::Index>(e));
  return parts;
}

// Parents stand before their children: from the last element to the first each is eliminated into
// its parent, and from the first to the last each follows from it.
std::optional<std::vector<Six>> solve_tree(const System& system) {
  const int n = system.model.size();
  std::vector<Block> diagonal = system.diagonal;
  std::vector<Six> right = system.right;
  std::vector<Eigen::LLT<Block>> pivot(n);
  for (int e = n - 1; e >= 0; --e) {
    pivot[e].compute(diagonal[e]);
    if (pivot[e].info() != Eigen::Success) return std::nullopt;
    const int parent = system.model.elements[e].parent;
    if (parent < 0) continue;
    const Block& coupling = system.coupling[e];
    diagonal[parent] -= coupling.transpose() * pivot[e].solve(coupling);
    right[parent] -= coupling.transpose() * pivot[e].solve(right[e]);
  }
  std::vector<Six> x(n);
  for (int e = 0; e < n; ++e) {
    const int parent = system.model.elements[e].parent;
    Six known = right[e];
    if (parent >= 0) known -= system.coupling[e] * x[parent];
    x[e] = pivot[e].solve(known);
  }
  return x;
}

}  // namespace

System::System(const cosserat::RodModel& m)
    : model(m),
      diagonal(m.elements.size(), Block::Zero()),
      coupling(m.elements.size(), Block::Zero()),
      weld(m.welds.size(), Block::Zero()),
      right(m.elements.size(), Six::Zero()) {}

std::optional<std::vector<Six>> solve(const System& system) {
  return system.weld.empty() ? solve_tree(system) : solve_sparse(system);
}

std::optional<std::vector<Six>> solve_sparse(const System& system) {
  std::vector<Eigen::Triplet<double>> entries;
  for_each_entry(system, [&](int i, int j, double value) { entries.emplace_back(i, j, value); });
  const int size = 6 * system.model.size();
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success || (factor.vectorD().array() <= 0.0).any())
    return std::nullopt;
  return parted(factor.solve(stacked(system.right)));
}

std::optional<std::vector<Six>> solve_dense(const System& system) {
  const int size = 6 * system.model.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for_each_entry(system, [&](int i, int j, double value) { matrix(i, j) += value; });
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return parted(factor.solve(stacked(system.right)));
}

std::vector<Six> residual(const System& system, const std::vector<Six>& x) {
  std::vector<Six> r = system.right;
  for (int e = 0; e < system.model.size(); ++e) {
    r[e] -= system.diagonal[e] * x[e];
    const int parent = system.model.elements[e].parent;
    if (parent < 0) continue;
    r[e] -= system.coupling[e] * x[parent];
    r[parent] -= system.coupling[e].transpose() * x[e];
  }
  for (std::size_t w = 0; w < system.weld.size(); ++w) {
    const auto [a, b] = std::pair(system.model.welds[w].a, system.model.welds[w].b);
    r[b] -= system.weld[w] * x[a];
    r[a] -= system.weld[w].transpose() * x[b];
  }
  return r;
}

std::vector<Six> residual_bound(const System& system, const std::vector<Six>& errors) {
  const int n = system.model.size();
  std::vector<double> own(n), near(n);
  const auto roots = [&](int e) -> Six { return system.diagonal[e].diagonal().cwiseSqrt(); };
  for (int e = 0; e < n; ++e) own[e] = near[e] = roots(e).dot(errors[e]);
  const auto join = [&](int a, int b) {
    near[a] += own[b];
    near[b] += own[a];
  };
  for (int e = 0; e < n; ++e)
    if (system.model.elements[e].parent >= 0) join(e, system.model.elements[e].parent);
  for (const cosserat::Weld& weld : system.model.welds) join(weld.a, weld.b);
  std::vector<Six> bound(n);
  for (int e = 0; e < n; ++e) bound[e] = near[e] * roots(e);
  return bound;
}

}  // namespace pedicel::plain
