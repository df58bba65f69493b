#include "plugins/discrepancy/report/scene_next_report.h"

#include <algorithm>

#include "engine/io/atomic_file.h"
#include "engine/plots/svg_plot.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

std::string channel_plot(const SceneNext& next) {
  const SceneNext::Channel& shown = next.channel;
  const double scale = shown.unit == "m" ? 1.0e3 : 1.0;
  plots::LinePlot plot;
  plot.title = "What each explanation predicts for it: " + shown.name;
  plot.x.label = "time (s)";
  plot.y.label = shown.name + " (" + (shown.unit == "m" ? "mm" : shown.unit) + ")";
  plot.width = 900;
  plot.height = 300;
  for (std::size_t i = 0; i < shown.series.size(); ++i) {
    std::vector<double> y;
    for (const double v : shown.series[i]) y.push_back(scale * v);
    if (i == 0) {
      plots::PlotBand band{"twice the noise", shown.time, y, y};
      for (double& low : band.low) low -= 2.0 * scale * shown.noise;
      for (double& high : band.high) high += 2.0 * scale * shown.noise;
      plot.bands = {band};
    }
    plot.series.push_back({next.names[i], shown.time, y});
    plot.series.back().dashed = i > 0;
  }
  return plots::to_svg(plot);
}

// "payload and wrench_bias" as the name of a folder.
std::string folder_name(std::string name) {
  std::ranges::replace(name, ' ', '_');
  return "predicted_" + name;
}

/// The trial with what a model predicts in its tables; what drives the arm is left out.
Trial predicted_trial(Trial trial, const SceneReadings& readings) {
  const auto take = [](Samples& samples, const Eigen::MatrixXd& values) {
    if (samples.size() > 0) samples.value = values;
  };
  trial.commands = {};
  if (trial.follows_commands)
    take(trial.joints, readings.joints);
  else
    trial.joints = {};
  take(trial.markers, readings.markers);
  for (std::size_t c = 0; c < trial.pixels.size(); ++c) take(trial.pixels[c], readings.pixels[c]);
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
    take(trial.wrenches[w], readings.wrenches[w]);
  take(trial.torques, readings.torques);
  trial.events = readings.events;
  return trial;
}

}  // namespace

void add_next_motion(io::HtmlReport& page, const SceneNext& next) {
  if (next.tried.empty()) return;
  page.heading("The motion that decides");
  page.paragraph(next.sentence + ".");
  if (next.experiment) page.plot(channel_plot(next));
  std::string names;
  for (const std::string& name : next.names) names += (names.empty() ? "" : ", ") + name;
  page.paragraph("Motions of the arm that were tried out, for " + names +
                 ": by how much the first of them then differs from the one nearest to it, in "
                 "noise units over all samples. Refitted: what stays where the numbers of both "
                 "models are fitted again, as far as the trials so far leave them open.");
  std::vector<std::vector<std::string>> rows;
  for (const SceneNext::Tried& one : next.tried)
    rows.push_back({one.action, short_number(one.apart),
                    one.refitted ? short_number(*one.refitted) : "\u2013"});
  page.table({"motion", "as fitted", "refitted"}, rows);
}

std::string write_scene_next(const std::filesystem::path& folder, const SceneNext& next) {
  if (!next.experiment) return {};
  const Experiment& plan = *next.experiment;
  const Trial& trial = plan.trials.front();
  const std::filesystem::path into = folder / "next";
  write_experiment(into, plan);
  for (std::size_t m = 0; m < next.predictions.size(); ++m)
    write_tables(into / trial.name / folder_name(next.names[m]), plan,
                 predicted_trial(trial, next.predictions[m]));
  io::write_file_atomically(into / trial.name / "predictions.svg", channel_plot(next));
  return "next/experiment.yaml";
}

}  // namespace pedicel::discrepancy
