#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double patience = 0.1;  // s, in which a resting plant moves by less than the noise
// A swing stands still for a moment at each of its turns. That is no rest.
constexpr double least_length = 0.2;  // s
constexpr int least_samples = 8;

}  // namespace

// Means of every marker's residual over a stretch. What is left of a swing that the model has too
// little of widens the error: its mean over some periods is of the order of its scatter by root n.
// A mean by generalised least squares: with noise that has a memory, samples at the ends of a
// stretch count more than those in its middle.
StaticStretch stretch_of(const SymptomContext& context, int t, int from, int to) {
  const Trial& trial = context.trial(t);
  const Eigen::Index columns = trial.markers.value.cols();
  StaticStretch stretch{
      t, from, to, Eigen::VectorXd::Constant(columns, nan), Eigen::VectorXd::Constant(columns, nan),
      {}};
  stretch.position =
      context.predictions[t].markers.middleRows(from, to - from).colwise().mean().transpose();
  for (Eigen::Index c = 0; c < columns; ++c) {
    const Series part = context.residual(t, static_cast<int>(c)).segment(from, to - from);
    Projection constant(1);
    constant.add(part, Eigen::MatrixXd::Ones(part.size(), 1), context.data.position_noise());
    Projection::Result result;
    // A marker that was hidden for most of the stretch stays NaN, and who reads it leaves it out.
    if (!constant.solve(result) || result.samples < least_samples / 2) continue;
    double scatter = 0.0;
    for (const double x : part)
      if (std::isfinite(x)) scatter += std::pow(x - result.value[0], 2) / result.samples;
    // Over the noise: above 1 something still moves.
    const double wider = std::sqrt(scatter) / context.data.position_noise().std;
    stretch.mean[c] = result.value[0];
    // Chance alone makes the scatter a little larger than the noise at times.
    stretch.error[c] = result.component(0).error * (wider > 1.5 ? wider : 1.0);
  }
  return stretch;
}

std::vector<StaticStretch> static_stretches(const SymptomContext& context) {
  std::vector<StaticStretch> stretches;
  // In m/s: what moves by less than a sample's noise in a tenth of a second rests as far as anyone
  // can see. Precise data so ask for a quieter plant.
  const double least_motion = context.data.position_noise().std / patience;
  for (int t = 0; t < context.trials(); ++t) {
    if (!context.usable(t)) continue;
    // Of the model, and not of the data, whose differences are noise. A plant that still swings
    // while the model rests is dealt with by the wider error.
    const Eigen::MatrixXd v = context.velocity(t);
    const std::vector<double>& time = context.trial(t).markers.time;
    // A stretch never goes over a jump of the drive.
    const auto ends = spans_of(context.trial(t));
    const auto span_at = [&](double at) {
      int s = 0;
      while (s + 1 < static_cast<int>(ends.size()) && at >= ends[s].to - 1e-9) ++s;
      return s;
    };
    int from = -1;
    const auto close = [&](int to) {
      if (from >= 0 && to - from >= least_samples && time[to - 1] - time[from] >= least_length)
        stretches.push_back(stretch_of(context, t, from, to));
      from = -1;
    };
    for (int i = 0; i < static_cast<int>(time.size()); ++i) {
      const bool rests = v.row(i).cwiseAbs().maxCoeff() < least_motion;
      // A load that is put on gently leaves the plant at rest on both sides, at two places.
      if (from >= 0 && span_at(time[i]) != span_at(time[from])) close(i);
      // One sample that moves ends a stretch, and the next one begins anew.
      if (rests && from < 0) from = i;
      if (!rests) close(i);
    }
    close(static_cast<int>(time.size()));
  }
  return stretches;
}

std::string stretch_name(const SymptomContext& context, const StaticStretch& stretch) {
  const Trial& trial = context.trial(stretch.trial);
  char text[64];
  // With its times, since a trial may rest several times.
  std::snprintf(text, sizeof text, ", %.3g to %.3g s", trial.markers.time[stretch.from],
                trial.markers.time[stretch.to - 1]);
  return trial.name + text;
}

}  // namespace pedicel::discrepancy
