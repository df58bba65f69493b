#include "pedicel/discrepancy/test/score_test.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

std::vector<double> score_statistics(const std::vector<Cause>& causes,
                                     const std::vector<Direction>& directions) {
  std::vector<double> score(causes.size(), 0.0);
  for (std::size_t i = 0; i < causes.size(); ++i)
    for (const Direction& direction : directions)
      if (direction.cause == causes[i].name)
        score[i] = std::max(score[i], std::abs(direction.statistic));
  return score;
}

std::vector<Cause> screened(const std::vector<Cause>& causes,
                            const std::vector<Direction>& directions, int most) {
  const std::vector<double> score = score_statistics(causes, directions);
  std::vector<std::size_t> order(causes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
  order.resize(std::min(static_cast<std::size_t>(most), order.size()));
  std::vector<Cause> chosen;
  for (const std::size_t i : order) chosen.push_back(causes[i]);
  return chosen;
}

}  // namespace pedicel::discrepancy
