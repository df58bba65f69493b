#include "pedicel/discrepancy/data/more_trials.h"

#include <algorithm>
#include <limits>

#include "pedicel/core/check.h"

namespace pedicel::discrepancy {

namespace {

[[noreturn]] void refuse(const Experiment& more, const std::string& why) {
  throw UsageError(more.folder.string() + ": " + why);
}

// Where each of the experiment's markers stands in `more`; -1 where it was not measured.
std::vector<int> order_of(const Experiment& more, const Experiment& experiment) {
  std::vector<int> order;
  for (const Marker& marker : experiment.markers) {
    const auto found = std::ranges::find(more.markers, marker.name, &Marker::name);
    if (found == more.markers.end()) {
      order.push_back(-1);
      continue;
    }
    if (!(found->place == marker.place))
      refuse(more, "marker \"" + marker.name +
                       "\" sits elsewhere than before, expected the same place or another name");
    order.push_back(static_cast<int>(found - more.markers.begin()));
  }
  for (const Marker& marker : more.markers)
    if (std::ranges::find(experiment.markers, marker.name, &Marker::name) ==
        experiment.markers.end())
      refuse(more, "marker \"" + marker.name + "\" is not among those before");
  return order;
}

Samples in_order(const Samples& samples, const std::vector<int>& order) {
  Samples sorted;
  sorted.time = samples.time;
  sorted.value.setConstant(samples.size(), 3 * static_cast<Eigen::Index>(order.size()),
                           std::numeric_limits<double>::quiet_NaN());
  for (std::size_t m = 0; m < order.size(); ++m)
    if (order[m] >= 0)
      sorted.value.middleCols<3>(3 * static_cast<Eigen::Index>(m)) =
          samples.value.middleCols<3>(3 * order[m]);
  return sorted;
}

}  // namespace

void add_trials(const Experiment& more, Experiment& experiment) {
  if (!(more.plant == experiment.plant))
    refuse(more, "its plant is not that of " + experiment.folder.string() +
                     ", expected the same plant file");
  const std::vector<int> order = order_of(more, experiment);
  for (const Trial& trial : more.trials) {
    if (std::ranges::find(experiment.trials, trial.name, &Trial::name) != experiment.trials.end())
      refuse(more, "trial \"" + trial.name + "\" is there already, expected another name");
    Trial added = trial;
    added.markers = in_order(trial.markers, order);
    // What is known of its instruments was said once for all of its trials.
    added.effects.insert(added.effects.begin(), more.effects.begin(), more.effects.end());
    for (const plant::Effect& known : experiment.effects)
      std::erase(added.effects, known);  // it holds here already
    experiment.trials.push_back(std::move(added));
  }
}

}  // namespace pedicel::discrepancy
