#include "plugins/discrepancy/report/report_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/plots/svg_heat_map.h"
#include "engine/plots/svg_plot.h"
#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/simulate/channel.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* dark = "#1f2328";
constexpr std::array<const char*, model_count> colours = {"#8c959f", "#1b6ca8", "#d1495b"};
constexpr std::array<const char*, model_count> names = {"nominal", "refitted", "extended"};
constexpr int page_width = 840;
constexpr int most_columns = 140;  // of a map

/// A channel's samples and its prediction, in millimetres or newtons.
struct Shown {
  std::vector<double> time, measured;
  std::array<std::vector<double>, model_count> model;
  double noise = 0.0;  // standard deviation
  std::string unit, name;
};

Shown shown(const ReportData& report, const ReportChannel& channel) {
  const ChannelPlace at = channel_at(report.experiment, channel.trial, channel.column);
  const bool is_place = at.kind == ChannelKind::position;
  const double scale = is_place ? 1e3 : 1.0;
  Shown result;
  result.time = at.samples->time;
  result.name = at.name;
  result.unit = is_place ? "mm" : at.unit;
  result.noise = scale * noise_of(report.data, at.kind).std;
  for (Eigen::Index i = 0; i < at.samples->value.rows(); ++i)
    result.measured.push_back(scale * at.samples->value(i, at.column));
  for (int m = 0; m < model_count; ++m) {
    const Prediction& p = report.prediction(static_cast<Model>(m), channel.trial);
    const Eigen::MatrixXd& value = p.*at.part;
    for (Eigen::Index i = 0; i < at.samples->value.rows(); ++i)
      result.model[m].push_back(
          i < value.rows() && at.column < value.cols() ? scale * value(i, at.column) : nan);
  }
  return result;
}

double rms(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  double sum = 0.0;
  int count = 0;
  for (const double x : values.reshaped())
    if (std::isfinite(x)) sum += x * x, ++count;
  return count > 0 ? std::sqrt(sum / count) : nan;
}

plots::PlotBand band(const std::string& label, const std::vector<double>& x,
                     const std::vector<double>& middle, double half) {
  plots::PlotBand result{label, x, middle, middle};
  for (double& y : result.low) y -= half;
  for (double& y : result.high) y += half;
  return result;
}

}  // namespace

ReportData::ReportData(const Diagnosis& d)
    : experiment(d.admission.experiment), diagnosis(d), data(experiment) {
  data.set_noise(d.position_noise, d.force_noise);
  predicted = std::ranges::all_of(d.predictions, [&](const auto& list) {
    return list.size() == experiment.trials.size() && !list.empty();
  });
  extended = predicted && d.best.hypothesis.effects.size() > d.base.hypothesis.effects.size();
}

std::optional<ReportChannel> liveliest(const ReportData& report, int trial) {
  const Eigen::MatrixXd& value = report.experiment.trials[trial].markers.value;
  std::optional<ReportChannel> best;
  for (int c = 0; c < value.cols(); ++c) {
    double low = 1e300, high = -1e300;
    for (const double x : value.col(c))
      if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
    if (high > low && (!best || high - low > best->size))
      best = ReportChannel{trial, c, high - low};
  }
  return best;
}

std::optional<ReportChannel> worst(const ReportData& report, int trial, Model model) {
  const Eigen::MatrixXd r = report.data.scaled_residual(trial, report.prediction(model, trial));
  std::optional<ReportChannel> best;
  for (int c = 0; c < r.cols(); ++c) {
    const double size = rms(r.col(c));
    if (std::isfinite(size) && (!best || size > best->size)) best = ReportChannel{trial, c, size};
  }
  return best;
}

std::optional<ReportChannel> worst(const ReportData& report, Model model) {
  std::optional<ReportChannel> best;
  for (int t = 0; t < static_cast<int>(report.experiment.trials.size()); ++t)
    if (const auto one = worst(report, t, model); one && (!best || one->size > best->size))
      best = one;
  return best;
}

std::string path_plot(const ReportData& report, const ReportChannel& channel) {
  const Shown s = shown(report, channel);
  plots::LinePlot plot;
  plot.title = report.experiment.trials[channel.trial].name + ": " + s.name;
  plot.x.label = "time (s)";
  plot.y.label = (s.unit == "N"    ? "force ("
                  : s.unit == "mm" ? "position ("
                                   : "moment (") +
                 s.unit + ")";
  plot.width = page_width;
  plot.height = 320;
  plot.bands = {band("twice the noise", s.time, s.measured, 2.0 * s.noise)};
  plot.series.push_back({"measured", s.time, s.measured});
  plot.series.back().colour = dark;
  for (int m = 0; m < (report.extended ? model_count : model_count - 1); ++m) {
    plot.series.push_back({names[m], s.time, s.model[m]});
    plot.series.back().colour = colours[m];
    plot.series.back().dashed = m == extended;
  }
  return plots::to_svg(plot);
}

std::string residual_plot(const ReportData& report, const ReportChannel& channel, int width) {
  const Shown s = shown(report, channel);
  plots::LinePlot plot;
  plot.title = "Measured less simulated, " + s.name + " in " +
               named_trial(report.experiment.trials[channel.trial].name);
  plot.x.label = "time (s)";
  plot.y.label = "residual (" + s.unit + ")";
  plot.width = width;
  plot.height = 340;
  plot.bands = {
      band("twice the noise", s.time, std::vector<double>(s.time.size(), 0.0), 2.0 * s.noise)};
  for (int m = refitted; m < (report.extended ? model_count : model_count - 1); ++m) {
    std::vector<double> r;
    for (std::size_t i = 0; i < s.time.size(); ++i) r.push_back(s.measured[i] - s.model[m][i]);
    plot.series.push_back({m == refitted ? "before (refitted)" : "after (extended)", s.time, r});
    plot.series.back().colour = colours[m];
  }
  return plots::to_svg(plot);
}

std::string residual_map(const ReportData& report, int trial, Model model) {
  const Trial& t = report.experiment.trials[trial];
  const Eigen::MatrixXd r = report.data.scaled_residual(trial, report.prediction(model, trial));
  const double end = std::max(t.duration(), 1e-9);
  // No finer than the coarser of both records, so that none has empty columns between its samples.
  const int samples =
      t.force.size() > 0 ? std::min(t.markers.size(), t.force.size()) : t.markers.size();
  const int columns = std::clamp(samples, 1, most_columns);
  plots::HeatMap map;
  map.title = t.name + ": " + names[model];
  map.x_label = "time (s)";
  map.value_label = "RMS residual in noise units:";
  map.width = page_width;
  map.levels = {1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0, 100.0};
  for (int c = 0; c <= columns; ++c) map.edges.push_back(end * c / columns);
  for (Eigen::Index row = 0; 3 * row < r.cols(); ++row) {
    const ChannelPlace at = channel_at(report.experiment, trial, static_cast<int>(3 * row));
    const Samples& record = *at.samples;
    map.rows.push_back(at.name.substr(0, at.name.rfind('.')));
    std::vector<double> sum(columns, 0.0), count(columns, 0.0);
    for (Eigen::Index i = 0; i < record.size(); ++i)
      for (Eigen::Index k = 3 * row; k < std::min(3 * row + 3, r.cols()); ++k) {
        if (!std::isfinite(r(i, k))) continue;
        const int c = std::clamp(static_cast<int>(record.time[i] / end * columns), 0, columns - 1);
        sum[c] += r(i, k) * r(i, k);
        count[c] += 1.0;
      }
    map.value.emplace_back();
    for (int c = 0; c < columns; ++c)
      map.value.back().push_back(count[c] > 0.0 ? std::sqrt(sum[c] / count[c]) : nan);
  }
  return plots::to_svg(map);
}

std::string symptom_plot(const Symptom& symptom, const std::string& model) {
  if (symptom.plot.series.empty()) return {};
  plots::LinePlot plot;
  plot.title = symptom.plot.title + (model.empty() ? "" : ": " + model);
  // A title that would run out of the picture goes without its subject.
  if (plot.title.size() > 56) plot.title = symptom.name + (model.empty() ? "" : ": " + model);
  plot.x.label = symptom.plot.x_label;
  plot.y.label = symptom.plot.y_label;
  plot.width = 440;
  plot.height = 320;
  const std::array<const char*, 2> palette = {
      dark, model == "extended" ? colours[extended] : colours[refitted]};
  for (std::size_t i = 0; i < symptom.plot.series.size(); ++i) {
    const SymptomSeries& s = symptom.plot.series[i];
    plot.series.push_back({s.label, s.x, s.y, s.line, !s.line});
    plot.series.back().colour = palette[i % 2];
  }
  return plots::to_svg(plot);
}

std::string error_bars(const Errors& errors, const std::string& title) {
  plots::BarChart chart;
  chart.title = title;
  chart.y_label = "RMS residual over the noise";
  chart.width = 400;
  chart.height = 300;
  chart.bars = {{"noise floor", 1.0, "#c9ced4"},
                {names[0], errors.nominal.value_or(nan), colours[0]},
                {names[1], errors.refitted.value_or(nan), colours[1]},
                {names[2], errors.extended.value_or(nan), colours[2]}};
  return plots::to_svg(chart);
}

std::string prediction_plot(const NextExperiment& next) {
  if (next.series.empty()) return {};
  const bool force = next.unit == "N";
  const double scale = force ? 1.0 : 1e3;
  plots::LinePlot plot;
  plot.title = "What each explanation predicts for it: " + next.channel;
  plot.x.label = "time (s)";
  plot.y.label = force ? "force (N)" : "position (mm)";
  plot.width = page_width - 60;
  plot.height = 300;
  for (std::size_t i = 0; i < next.series.size(); ++i) {
    std::vector<double> y;
    for (const double v : next.series[i]) y.push_back(scale * v);
    if (i == 0) plot.bands = {band("twice the noise", next.time, y, 2.0 * scale * next.noise)};
    plot.series.push_back({next.names[i], next.time, y});
    plot.series.back().dashed = i > 0;
  }
  return plots::to_svg(plot);
}

}  // namespace pedicel::discrepancy
