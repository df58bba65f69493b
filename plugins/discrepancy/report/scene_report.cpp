#include "plugins/discrepancy/report/scene_report.h"

#include <cmath>
#include <functional>

#include "engine/io/atomic_file.h"
#include "engine/plots/svg_plot.h"
#include "plugins/discrepancy/report/report_plots.h"
#include "plugins/discrepancy/report/report_words.h"
#include "plugins/discrepancy/report/scene_next_report.h"
#include "plugins/discrepancy/report/verdict_tables.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_told = 3;  // symptoms on a terminal

struct ShownColumn {
  std::string title, unit;
  double scale = 1.0;
  const Samples* samples = nullptr;
  const Eigen::MatrixXd *nominal = nullptr, *refitted = nullptr, *extended = nullptr;
  long column = 0;
  double size = -1.0;  // RMS of the refitted residual, in its unit
};

// The column of a table that the refitted model misses most.
void choose(ShownColumn& best, const Samples& samples, const Eigen::MatrixXd& model, double scale,
            const std::function<void(long)>& take) {
  for (long c = 0; c < samples.value.cols(); ++c) {
    double square = 0.0;
    int count = 0;
    for (long r = 0; r < samples.size(); ++r) {
      const double d = scale * (samples.value(r, c) - model(r, c));
      if (!std::isfinite(d)) continue;
      square += d * d;
      ++count;
    }
    const double size = count > 0 ? std::sqrt(square / count) : -1.0;
    if (size <= best.size) continue;
    best.size = size;
    best.column = c;
    best.scale = scale;
    best.samples = &samples;
    take(c);
  }
}

std::string plot_of(const ShownColumn& shown, bool extended) {
  const auto series = [&](const std::string& label, const Eigen::MatrixXd& values,
                          const std::string& colour) {
    plots::PlotSeries one;
    one.label = label;
    one.colour = colour;
    for (long r = 0; r < shown.samples->size(); ++r) {
      one.x.push_back(shown.samples->time[static_cast<std::size_t>(r)]);
      one.y.push_back(shown.scale * values(r, shown.column));
    }
    return one;
  };
  plots::LinePlot plot;
  plot.title = shown.title;
  plot.x.label = "time (s)";
  plot.y.label = shown.unit;
  plot.width = 900;
  plot.height = 300;
  plot.series = {series("measured", shown.samples->value, "#24292f"),
                 series("nominal", *shown.nominal, "#c77d0a"),
                 series("refitted", *shown.refitted, "#3b76c4")};
  if (extended) {
    plot.series.push_back(series("extended", *shown.extended, "#2e8b57"));
    plot.series.back().dashed = true;
  }
  return plots::to_svg(plot);
}

void add_trial(io::HtmlReport& page, const Experiment& experiment, const SceneDiagnosis& d,
               std::size_t t) {
  const Trial& trial = experiment.trials[t];
  const SceneReadings &a = d.nominal[t], &b = d.refitted[t], &c = d.extended[t];
  const bool extended = d.findings.explained();
  constexpr const char* axes[] = {"x", "y", "z"};
  ShownColumn marker;
  choose(marker, trial.markers, b.markers, 1.0e3, [&](long column) {
    marker.title = trial.name + ": " +
                   experiment.markers[static_cast<std::size_t>(column / 3)].name + "." +
                   axes[column % 3];
    marker.unit = "position (mm)";
  });
  marker.nominal = &a.markers;
  marker.refitted = &b.markers;
  marker.extended = &c.markers;
  if (marker.samples) page.plot(plot_of(marker, extended));
  for (std::size_t w = 0; w < trial.wrenches.size(); ++w) {
    ShownColumn force;
    if (trial.wrenches[w].value.cols() < 3) continue;
    const Samples only{trial.wrenches[w].time, trial.wrenches[w].value.leftCols(3)};
    choose(force, only, b.wrenches[w], 1.0, [&](long column) {
      force.title = trial.name + ": force " + axes[column] + " at " + experiment.wrenches[w].name;
      force.unit = "force (N)";
    });
    force.nominal = &a.wrenches[w];
    force.refitted = &b.wrenches[w];
    force.extended = &c.wrenches[w];
    if (force.samples) page.plot(plot_of(force, extended));
  }
}

std::string trial_names(const Experiment& experiment, const std::vector<int>& trials) {
  std::string text;
  for (const int t : trials)
    text += (text.empty() ? "" : ", ") + experiment.trials[static_cast<std::size_t>(t)].name;
  return text;
}

void add_competing(io::HtmlReport& page, const SceneDiagnosis& d) {
  if (d.findings.candidates.size() < 2) return;
  page.subheading("What else it could have been");
  std::vector<std::vector<std::string>> rows;
  for (const SceneCandidate& one : d.findings.candidates)
    rows.push_back({joined_names(one.names), short_number(one.excess),
                    one.check_excess ? short_number(*one.check_excess) : "\u2013"});
  page.table({"model", "left beyond the noise (noise units)", "held out"}, rows);
}

}  // namespace

std::string scene_certainty_text(const SceneDiagnosis& d) {
  const Verdict& v = d.verdict;
  std::string text = "Fitted were " + std::to_string(d.fit_trials.size()) + " trials, held out " +
                     std::to_string(d.check_trials.size()) + ".";
  if (v.outcome == Outcome::ambiguous)
    text += " More than one cause does nearly as well as the best.";
  if (v.outcome == Outcome::unknown && !d.findings.clean.empty())
    text += " The material is that of the trials in which nothing else shows.";
  return text;
}

std::string scene_gain_text(const SceneDiagnosis& d) {
  const Verdict& v = d.verdict;
  const bool held = v.check.refitted.has_value();
  const Errors& e = held ? v.check : v.fit;
  if (!e.refitted) return "";
  std::string text = std::string(held ? "On the held-out trials" : "On the fitted trials") +
                     " the residual is " + short_number(*e.nominal) +
                     " times the noise as the files say, " + short_number(*e.refitted) +
                     " with the refitted model";
  if (d.findings.explained())
    text += ", and " + short_number(*e.extended) + " with the extended one";
  text += ".";
  if (v.gain) text += " That removes " + share_removed(*v.gain) + " of the error above the noise.";
  return text;
}

std::string scene_next_text(const Verdict& v) {
  if (!v.next_experiment.empty()) return v.next_experiment + ".";
  if (v.outcome == Outcome::adequate)
    return "Nothing is missing at this noise. Use the refitted parameters below.";
  if (v.outcome == Outcome::named)
    return v.extended_scene.empty() ? "No further experiment is needed for this."
                                    : "No further experiment is needed for this. Use " +
                                          v.extended_scene + " in place of the nominal scene.";
  return "Repeat the trial with the largest residual, with one more marker where it is largest.";
}

std::string scene_report_text(const Experiment& experiment, const SceneDiagnosis& d) {
  const Verdict& v = d.verdict;
  io::HtmlReport page(
      experiment.title.empty() ? "Diagnosis" : experiment.title,
      "What the simulation of this scene gets wrong: " + std::to_string(experiment.trials.size()) +
          " trials, " + std::to_string(v.simulations) + " simulations, " + short_number(v.seconds) +
          " s");
  page.begin_card();
  page.note(headline(v), v.outcome == Outcome::adequate || v.outcome == Outcome::named);
  page.paragraph(scene_certainty_text(d));
  const std::string remainder = remainder_text(v);
  if (!remainder.empty()) page.paragraph(remainder);
  add_symptom_numbers(page, v);
  add_causes(page, v);
  const std::string gain = scene_gain_text(d);
  if (!gain.empty()) {
    page.subheading("What it gains");
    page.paragraph(gain);
  }
  add_competing(page, d);
  add_detectable_limits(page, v);
  page.subheading("What to do next");
  page.paragraph(scene_next_text(v));
  page.end_card();
  add_next_motion(page, d.next);
  page.heading("Measured against simulated");
  page.paragraph("Fitted: " + trial_names(experiment, d.fit_trials) + ". Held out: " +
                 (d.check_trials.empty() ? "none" : trial_names(experiment, d.check_trials)) + ".");
  for (std::size_t t = 0; t < d.extended.size() && t < d.refitted.size(); ++t)
    add_trial(page, experiment, d, t);
  page.heading("The residual over the noise floor");
  std::vector<std::string> bars = {error_bars(v.fit, "fitted trials")};
  if (v.check.refitted) bars.push_back(error_bars(v.check, "held-out trials"));
  page.plots(bars);
  if (!v.symptoms.empty()) {
    page.heading("Symptoms");
    std::vector<std::string> sentences;
    for (const SymptomNumber& one : v.symptoms)
      sentences.push_back(one.sentence + (one.shows ? "" : " It does not leave the noise."));
    page.list(sentences);
  }
  page.heading("Parameters");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, estimate] : v.parameters) rows.push_back({name, estimate_text(estimate)});
  for (const NamedCause& cause : v.causes)
    for (const auto& [name, estimates] : cause.parameters)
      rows.push_back({cause.name + ", " + name, estimate_text(estimates)});
  if (!rows.empty()) page.table({"parameter", "value"}, rows);
  return page.text();
}

std::string scene_card_text(const SceneDiagnosis& d) {
  const Verdict& v = d.verdict;
  std::string text = headline(v) + "\n";
  for (const NamedCause& cause : v.causes)
    for (const auto& [name, estimates] : cause.parameters)
      text += "  " + cause.name + ", " + name + ": " + estimate_text(estimates) + "\n";
  const std::string gain = scene_gain_text(d);
  if (!gain.empty()) text += "  " + gain + "\n";
  std::size_t told = 0;
  for (const SymptomNumber& one : v.symptoms)
    if (one.shows && told++ < most_told) text += "  " + one.sentence + "\n";
  if (v.outcome != Outcome::adequate) text += "  Next: " + scene_next_text(v) + "\n";
  return text;
}

void write_scene_report(const std::filesystem::path& folder, const Experiment& experiment,
                        const SceneDiagnosis& diagnosis) {
  io::write_file_atomically(folder / "report.html", scene_report_text(experiment, diagnosis));
}

}  // namespace pedicel::discrepancy
