#include "plugins/discrepancy/data/more_trials.h"

#include <limits>

#include "plugins/discrepancy/data/joined_trials.h"

namespace pedicel::discrepancy {

Samples in_order(const Samples& samples, const std::vector<int>& order, int each) {
  Samples sorted;
  // A table that was not measured has no columns to sort.
  if (samples.value.cols() == 0) return sorted;
  sorted.time = samples.time;
  sorted.value.setConstant(samples.size(), each * static_cast<Eigen::Index>(order.size()),
                           std::numeric_limits<double>::quiet_NaN());
  for (std::size_t m = 0; m < order.size(); ++m)
    if (order[m] >= 0)
      sorted.value.middleCols(each * static_cast<Eigen::Index>(m), each) =
          samples.value.middleCols(each * order[m], each);
  return sorted;
}

void add_trials(const Experiment& more, Experiment& experiment) {
  if (!(more.plant == experiment.plant))
    refuse_to_join(more, "its plant is not that of " + experiment.folder.string() +
                             ", expected the same plant file");
  const std::vector<int> order = order_of(
      more, "marker", experiment.markers, more.markers,
      [](const Marker& a, const Marker& b) { return a.place == b.place; },
      "sits elsewhere than before, expected the same place or another name");
  for (const Trial& trial : more.trials) {
    Trial added = trial;
    added.markers = in_order(trial.markers, order, 3);
    join_trial(more, std::move(added), experiment);
  }
}

}  // namespace pedicel::discrepancy
