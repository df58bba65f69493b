#include "pedicel/discrepancy/test/score_test.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_promising = 12;

}  // namespace

std::vector<double> promise_of(const std::vector<Cause>& causes,
                               const std::vector<Direction>& directions) {
  std::vector<double> promise(causes.size(), 0.0);
  for (std::size_t i = 0; i < causes.size(); ++i)
    for (const Direction& direction : directions)
      if (direction.cause == causes[i].name)
        promise[i] = std::max(promise[i], std::abs(direction.statistic));
  return promise;
}

std::vector<Cause> promising(const std::vector<Cause>& causes,
                             const std::vector<Direction>& directions) {
  const std::vector<double> promise = promise_of(causes, directions);
  std::vector<std::size_t> order(causes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return promise[a] > promise[b]; });
  order.resize(std::min(most_promising, order.size()));
  std::vector<Cause> chosen;
  for (const std::size_t i : order) chosen.push_back(causes[i]);
  return chosen;
}

}  // namespace pedicel::discrepancy
