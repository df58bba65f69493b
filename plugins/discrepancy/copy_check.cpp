// Copies. Two measurements never agree to the last digit.
#include <cmath>

#include "discrepancy/beside.h"

namespace pedicel::discrepancy {

namespace {

constexpr int least_rows = 5;
constexpr double least_scatter = 1.0e-6;  // m: of less the data are of a simulation without noise

bool is_same(const Samples& a, const Samples& b) {
  if (a.size() != b.size() || a.size() < least_rows || a.value.cols() != b.value.cols())
    return false;
  const auto equal =
      (a.value.array() == b.value.array()) || (a.value.array().isNaN() && b.value.array().isNaN());
  return equal.all();
}

double explained(const TrialView& view) {
  double most = 0.0;
  if (view.layout)
    for (const Beside& beside : Beside::all_of(view)) most = std::max(most, beside.explained());
  return most;
}

// Of two equal ones: that which does less what its trial does to the plant, or comes later.
bool is_the_copy(const TrialView& one, const TrialView& other) {
  const double mine = explained(one), others = explained(other);
  return mine == others ? &one.trial > &other.trial : mine < others;
}

}  // namespace

std::optional<Fault> check_copies(const TrialView& view) {
  if (noise_of_markers(view) < least_scatter) return std::nullopt;
  for (const Trial& other : view.experiment.trials) {
    if (&other == &view.trial || !is_same(view.trial.markers, other.markers)) continue;
    if (!is_the_copy(view, {view.experiment, other, view.layout})) continue;
    return Fault{"markers.csv", "holds the same numbers as " +
                                    (other.folder / "markers.csv").string() +
                                    ": expected the trial's own; a file copied?"};
  }
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
