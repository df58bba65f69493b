#include "plugins/discrepancy/scene_procedure/scene_decoys.h"

#include <limits>

namespace pedicel::discrepancy {

namespace {

Eigen::VectorXd residual_of(const SceneDataSet& data, int trial, const SceneReadings& readings) {
  Eigen::VectorXd out(data.size(trial));
  data.residual(trial, readings, std::numeric_limits<double>::infinity(), out);
  return out;
}

/// Backwards, and at neighbours, table by table in the order of SceneDataSet::residual().
class Exchange {
 public:
  Exchange(const Eigen::VectorXd& change, Eigen::Ref<Eigen::VectorXd> reversed,
           Eigen::Ref<Eigen::VectorXd> exchanged)
      : change_(change), reversed_(reversed), exchanged_(exchanged) {
    reversed_.setZero();
    exchanged_.setZero();
  }
  /// `axes`: columns that are one marker's; 0: the table has no markers.
  void table(const Samples& samples, long axes) {
    const long rows = samples.size(), columns = samples.value.cols();
    for (long c = 0; c < columns; ++c) {
      const long at = first_ + c * rows;
      reversed_.segment(at, rows) = change_.segment(at, rows).reverse();
      if (axes == 0) continue;
      // By whole markers, so that x stays x.
      const long neighbour = first_ + (c + axes) % columns * rows;
      exchanged_.segment(at, rows) = change_.segment(neighbour, rows);
    }
    first_ += columns * rows;
  }

 private:
  const Eigen::VectorXd& change_;
  Eigen::Ref<Eigen::VectorXd> reversed_, exchanged_;
  long first_ = 0;
};

}  // namespace

Decoys scene_decoys(const Experiment& experiment, const SceneDataSet& data,
                    std::span<const int> trials, std::span<const SceneReadings> without,
                    std::span<const SceneReadings> with, double too_alike) {
  long rows = 0;
  for (const int t : trials) rows += data.size(t);
  Eigen::VectorXd residual(rows), change(rows), reversed(rows), exchanged(rows);
  long first = 0;
  for (const int t : trials) {
    const auto at = static_cast<std::size_t>(t);
    const Trial& trial = experiment.trials[at];
    const long size = data.size(t);
    const Eigen::VectorXd own = residual_of(data, t, without[at]);
    const Eigen::VectorXd moved = own - residual_of(data, t, with[at]);
    residual.segment(first, size) = own;
    change.segment(first, size) = moved;
    Exchange exchange(moved, reversed.segment(first, size), exchanged.segment(first, size));
    exchange.table(trial.markers, 3);
    for (const Samples& pixels : trial.pixels) exchange.table(pixels, 2);
    for (const Samples& wrench : trial.wrenches) exchange.table(wrench, 0);
    exchange.table(trial.torques, 0);
    if (trial.follows_commands) exchange.table(trial.joints, 0);
    first += size;
  }
  return decoys_of(residual, change, reversed, exchanged, too_alike);
}

}  // namespace pedicel::discrepancy
