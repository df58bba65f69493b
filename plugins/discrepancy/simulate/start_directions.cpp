#include "plugins/discrepancy/simulate/start_directions.h"

namespace pedicel::discrepancy {

void find_start_directions(Simulator& simulator, const Variant& variant, DataSet& data) {
  const double step = data.position_noise().std;
  std::vector<Variant> variants;
  std::vector<Simulator::Request> requests;
  const int trials = static_cast<int>(data.experiment().trials.size());
  std::size_t count = 0;
  for (int t = 0; t < trials; ++t)
    if (const int size = simulator.start_amplitudes(t); size > 0)
      count += static_cast<std::size_t>(size) + 1;
  if (count == 0) return;
  variants.reserve(count);  // requests point to them
  for (int t = 0; t < trials; ++t) {
    const int size = simulator.start_amplitudes(t);
    for (int i = -1; size > 0 && i < size; ++i) {
      Variant& one = variants.emplace_back(variant);
      if (i >= 0) {
        one.start_shift.assign(static_cast<std::size_t>(size), 0.0);
        one.start_shift[static_cast<std::size_t>(i)] = step;
      }
      requests.push_back({&one, t});
    }
  }
  const std::vector<Prediction> predicted = simulator.run(requests);
  for (std::size_t r = 0; r < requests.size();) {
    const int trial = requests[r].trial;
    const Prediction& plain = predicted[r++];
    std::vector<Prediction> directions;
    for (; r < requests.size() && requests[r].trial == trial; ++r) {
      Prediction change = predicted[r];
      change.markers -= plain.markers;
      change.force -= plain.force;
      change.wrench -= plain.wrench;
      directions.push_back(std::move(change));
    }
    data.set_start_directions(trial, std::move(directions));
  }
}

}  // namespace pedicel::discrepancy
