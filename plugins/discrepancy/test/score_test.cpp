#include "plugins/discrepancy/test/score_test.h"

#include <algorithm>
#include <cmath>

namespace pedicel::discrepancy {

std::vector<double> score_statistics(const std::vector<Cause>& causes,
                                     const std::vector<Direction>& directions) {
  std::vector<double> score(causes.size(), 0.0);
  // The largest over its starts: a cause with many places has as many directions, and one of them
  // is near. The sign says nothing, since a start may be of the wrong one.
  // A cause without a direction keeps a score of zero, and stands last.
  for (std::size_t i = 0; i < causes.size(); ++i)
    for (const Direction& direction : directions)
      if (direction.cause == causes[i].name)
        score[i] = std::max(score[i], std::abs(direction.statistic));
  return score;
}

std::vector<Cause> screened(const std::vector<Cause>& causes,
                            const std::vector<Direction>& directions, int most) {
  // Scores are all that tells causes apart without a fit. They are right where a cause is small,
  // and a first guess where it is large.
  const std::vector<double> score = score_statistics(causes, directions);
  std::vector<std::size_t> order(causes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  // Stable: equal scores keep the order of the list, so that a search repeats.
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return score[a] > score[b]; });
  // No level is asked for: what is chosen is fitted, and the fit decides.
  order.resize(std::min(static_cast<std::size_t>(most), order.size()));
  std::vector<Cause> chosen;
  for (const std::size_t i : order) chosen.push_back(causes[i]);
  return chosen;
}

}  // namespace pedicel::discrepancy
