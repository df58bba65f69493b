#include "app/session/measured/model_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/data/places.h"

namespace pedicel::app {

namespace {

constexpr double spacing = 0.015;  // m, of a shape's points
constexpr int most_points = 60;    // a curve
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double radius_at(const plant::PlantCurve& curve, double at) {
  if (curve.radius.empty()) return std::max(0.001, 0.5 * curve.section.height);
  if (curve.radius.size() == 1) return curve.radius.front();
  std::vector<double> arc{0.0};
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    arc.push_back(arc.back() + (curve.points[i] - curve.points[i - 1]).norm());
  const double here = at * arc.back();
  const auto beyond = std::upper_bound(arc.begin(), arc.end() - 1, here);
  const auto i = static_cast<std::size_t>(std::max<long>(1, beyond - arc.begin()));
  const double share = (here - arc[i - 1]) / std::max(1e-12, arc[i] - arc[i - 1]);
  return curve.radius[i - 1] +
         std::clamp(share, 0.0, 1.0) * (curve.radius[i] - curve.radius[i - 1]);
}

/// The experiment with the points of its plant as further markers that nobody has measured.
discrepancy::Experiment with_shape(discrepancy::Experiment experiment) {
  const auto measured = static_cast<Eigen::Index>(experiment.markers.size());
  for (const ShapeCurve& curve : shape_of(experiment.plant()))
    for (const double at : curve.at) {
      const std::string& name =
          experiment.plant().curves[static_cast<std::size_t>(curve.curve)].name;
      experiment.markers.push_back({"", {name, at, {}}});
    }
  const auto all = static_cast<Eigen::Index>(experiment.markers.size());
  for (discrepancy::Trial& trial : experiment.trials) {
    Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(trial.markers.size(), 3 * all, nan);
    wide.leftCols(3 * measured) = trial.markers.value.leftCols(3 * measured);
    trial.markers.value = std::move(wide);
  }
  return experiment;
}

TrialPath split(const discrepancy::Prediction& prediction, const discrepancy::Trial& trial,
                Eigen::Index markers) {
  TrialPath path;
  path.markers = prediction.markers.leftCols(3 * markers);
  path.shape = prediction.markers.rightCols(prediction.markers.cols() - 3 * markers);
  path.force = prediction.force;
  path.healthy = prediction.healthy;
  measure_error(trial, path);
  return path;
}

}  // namespace

std::vector<ShapeCurve> shape_of(const plant::PlantFile& plant) {
  std::vector<ShapeCurve> shape;
  int first = 0;
  for (std::size_t c = 0; c < plant.curves.size(); ++c) {
    ShapeCurve one{static_cast<int>(c), first, {}, {}};
    const double length = discrepancy::drawn_length(plant.curves[c]);
    const int parts = std::clamp(static_cast<int>(std::ceil(length / spacing)), 2, most_points);
    for (int i = 0; i <= parts; ++i) {
      one.at.push_back(static_cast<double>(i) / parts);
      one.radius.push_back(radius_at(plant.curves[c], one.at.back()));
    }
    first += parts + 1;
    shape.push_back(std::move(one));
  }
  return shape;
}

void measure_error(const discrepancy::Trial& trial, TrialPath& path) {
  double sum = 0.0;
  long samples = 0;
  path.marker_rms.clear();
  for (Eigen::Index m = 0; 3 * m < path.markers.cols(); ++m) {
    double own = 0.0;
    long seen = 0;
    for (Eigen::Index i = 0; i < path.markers.rows(); ++i) {
      const double error =
          (trial.markers.value.block<1, 3>(i, 3 * m) - path.markers.block<1, 3>(i, 3 * m))
              .squaredNorm();
      if (!std::isfinite(error)) continue;
      own += error;
      ++seen;
    }
    path.marker_rms.push_back(seen ? std::sqrt(own / static_cast<double>(seen)) : nan);
    sum += own;
    samples += seen;
  }
  path.rms = samples ? std::sqrt(sum / static_cast<double>(samples)) : nan;
}

void simulate_paths(const discrepancy::Experiment& experiment,
                    const std::vector<discrepancy::Variant>& variants,
                    const discrepancy::Numerics& numerics, const std::atomic<bool>& stop,
                    const std::function<void(int trial, int variant, TrialPath path)>& done) {
  const discrepancy::Experiment wide = with_shape(experiment);
  discrepancy::Simulator simulator(wide, numerics, 1, &stop);
  const auto markers = static_cast<Eigen::Index>(experiment.markers.size());
  for (std::size_t t = 0; t < wide.trials.size(); ++t) {
    std::vector<discrepancy::Simulator::Request> requests;
    for (const discrepancy::Variant& variant : variants)
      requests.push_back({&variant, static_cast<int>(t)});
    const std::vector<discrepancy::Prediction> all = simulator.run(requests);
    if (stop) return;
    for (std::size_t v = 0; v < all.size(); ++v)
      done(static_cast<int>(t), static_cast<int>(v), split(all[v], experiment.trials[t], markers));
  }
}

double residual_along(const discrepancy::Experiment& experiment,
                      const std::vector<double>& marker_rms, const std::string& curve, double at) {
  double below = -1.0, above = 2.0, low = nan, high = nan;
  for (std::size_t m = 0; m < experiment.markers.size() && m < marker_rms.size(); ++m) {
    const plant::CurvePlace& place = experiment.markers[m].place;
    if (place.curve != curve || !std::isfinite(marker_rms[m])) continue;
    if (place.at <= at && place.at > below) below = place.at, low = marker_rms[m];
    if (place.at >= at && place.at < above) above = place.at, high = marker_rms[m];
  }
  if (!std::isfinite(low)) return high;
  if (!std::isfinite(high) || above <= below) return low;
  return low + (at - below) / (above - below) * (high - low);
}

}  // namespace pedicel::app
