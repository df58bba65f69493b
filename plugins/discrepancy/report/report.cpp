#include "plugins/discrepancy/report/report.h"

#include <algorithm>

#include "engine/io/atomic_file.h"
#include "engine/io/csv.h"
#include "plugins/discrepancy/data/experiment_tables.h"
#include "plugins/discrepancy/files/experiment_files.h"
#include "plugins/discrepancy/report/report_card.h"
#include "plugins/discrepancy/report/report_plots.h"
#include "plugins/discrepancy/report/report_words.h"
#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr std::size_t most_mapped = 6;    // trials whose residual is drawn as a map
constexpr std::size_t most_symptoms = 4;  // drawn before and after
constexpr std::size_t most_ranked = 30;

std::vector<SymptomPair> symptom_pairs(const ReportData& report) {
  if (!report.predicted) return {};
  const auto of = [&](Model model) {
    return symptoms(report.experiment, report.data, report.diagnosis.predictions[model]);
  };
  return paired(of(refitted), report.extended ? of(extended) : std::vector<Symptom>{});
}

void add_paths(io::HtmlReport& page, const ReportData& report) {
  page.heading("Measured against simulated");
  page.paragraph(
      "Of each trial the channel that moves most, and the one with the largest residual of the "
      "refitted model. Nominal: the plant file as given. Refitted: the same model with modulus, "
      "density and damping fitted." +
      std::string(report.extended ? " Extended: with what was found." : ""));
  for (int t = 0; t < static_cast<int>(report.experiment.trials.size()); ++t) {
    const auto moving = liveliest(report, t);
    const auto largest = worst(report, t, refitted);
    if (moving) page.plot(path_plot(report, *moving));
    if (largest && (!moving || largest->column != moving->column))
      page.plot(path_plot(report, *largest));
  }
}

void add_maps(io::HtmlReport& page, const ReportData& report) {
  page.heading("The residual over markers and time");
  std::vector<std::pair<double, int>> order;
  for (int t = 0; t < static_cast<int>(report.experiment.trials.size()); ++t) {
    const auto largest = worst(report, t, refitted);
    order.emplace_back(largest ? -largest->size : 0.0, t);
  }
  std::ranges::stable_sort(order);
  if (order.size() > most_mapped) {
    page.paragraph("The " + std::to_string(most_mapped) + " trials with the largest residuals of " +
                   std::to_string(order.size()) + ".");
    order.resize(most_mapped);
  }
  for (const auto& [size, t] : order)
    for (int m = 0; m < (report.extended ? model_count : model_count - 1); ++m)
      page.plot(residual_map(report, t, static_cast<Model>(m)));
}

std::string value_text(const Symptom& symptom) {
  return symptom.name.empty() ? "\u2013"
                              : with_error(symptom.value, symptom.standard_error, symptom.unit);
}

std::string words_of(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& word : list) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void add_symptoms(io::HtmlReport& page, const ReportData& report,
                  const std::vector<SymptomPair>& pairs) {
  page.heading("Symptoms before and after");
  page.paragraph(
      "Measured less simulated, with one standard error from the noise. A symptom shows "
      "beyond 5 standard errors. Kinds of symptom that these trials cannot show are "
      "left out.");
  std::vector<std::vector<std::string>> rows;
  for (const SymptomPair& pair : pairs)
    rows.push_back({symptom_title(pair.before.name), pair.before.subject, value_text(pair.before),
                    report.extended ? value_text(pair.after) : "\u2013",
                    !pair.before.shows()                            ? "does not show"
                    : !report.extended                              ? "shows"
                    : pair.after.name.empty() || pair.after.shows() ? "shows, stays"
                                                                    : "shows, is gone",
                    words_of(pair.before.speaks_for)});
  page.table({"symptom", "of", "refitted", "extended", "", "speaks for"}, rows);
  std::size_t drawn = 0;
  for (const SymptomPair& pair : pairs) {
    if (!pair.before.shows() || drawn == most_symptoms) break;
    std::vector<std::string> plots{symptom_plot(pair.before, "refitted")};
    if (report.extended) plots.push_back(symptom_plot(pair.after, "extended"));
    std::erase(plots, "");
    if (plots.empty()) continue;
    page.paragraph(pair.before.sentence);
    page.plots(plots);
    ++drawn;
  }
}

void add_ranking(io::HtmlReport& page, const Diagnosis& d) {
  if (d.ranking.empty()) return;
  page.heading("All candidates, refitted in full");
  page.paragraph(
      "Gain: log-likelihood (nats) that the cause adds to the refitted model. Evidence: "
      "that and the gain on the held-out trials, less what its parameters and the number of "
      "candidates cost. Candidates without these two fell far behind and were not fitted to the "
      "end.");
  std::vector<std::vector<std::string>> rows;
  for (const Candidate& candidate : d.ranking) {
    if (rows.size() == most_ranked) break;
    if (candidate.whole)
      rows.push_back({candidate.cause, io::format_number(candidate.evidence, 4),
                      io::format_number(candidate.gain, 4), parameters_text(candidate),
                      why_it_lost(candidate, d)});
    else
      rows.push_back({candidate.cause, "-", "-", parameters_text(candidate), left_early});
  }
  page.table({"cause", "evidence", "gain", "parameters", "why it lost"}, rows);
}

void add_gain(io::HtmlReport& page, const Diagnosis& d) {
  page.heading("What it gains");
  const std::string words = gain_text(d);
  if (!words.empty()) page.paragraph(words);
  std::vector<std::string> plots;
  if (d.verdict.fit.nominal) plots.push_back(error_bars(d.verdict.fit, "Fitted trials"));
  if (d.verdict.check.nominal) plots.push_back(error_bars(d.verdict.check, "Held-out trials"));
  if (!plots.empty()) page.plots(plots);
}

void add_data(io::HtmlReport& page, const Experiment& given, const Diagnosis& d) {
  const Admission& a = d.admission;
  page.heading("The data");
  std::vector<std::vector<std::string>> rows;
  for (int t = 0; t < static_cast<int>(given.trials.size()); ++t) {
    const Trial& trial = given.trials[t];
    const bool fitted = std::ranges::find(d.fit_trials, t) != d.fit_trials.end();
    const bool kept = std::ranges::find(d.check_trials, t) != d.check_trials.end();
    rows.push_back({trial.name, io::format_number(trial.duration(), 4),
                    std::to_string(trial.markers.size()), std::to_string(trial.force.size()),
                    fitted ? "fitted"
                    : kept ? "held out"
                           : "not used"});
  }
  page.table({"trial", "length (s)", "marker samples", "force samples", "used as"}, rows);
  page.key_values({{"samples", std::to_string(a.samples)},
                   {"not seen", std::to_string(a.missing)},
                   {"outliers taken out", std::to_string(a.outliers)},
                   {"stuck samples taken out", std::to_string(a.stuck)},
                   {"swapped labels put back", std::to_string(a.swaps)}});
  if (!a.refusal.empty()) page.note(a.refusal, false);
  if (!a.remarks.empty()) page.list(a.remarks);
}

void add_detachments(io::HtmlReport& page, const StalkStrength& strength) {
  if (strength.stalks.empty()) return;
  page.heading("When fruits came off");
  page.paragraph(strength.summary());
  page.paragraph(
      "Loads of the stalks by the best model, the largest until the fruit came off or the "
      "trial ended, in units of what the thresholds or the law let them bear.");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < strength.stalks.size(); ++i) {
    const StalkLoads& stalk = strength.stalks[i];
    rows.push_back(
        {stalk.trial, stalk.fruit,
         std::isfinite(stalk.came_off) ? short_number(stalk.came_off) : "stayed on",
         short_number(strength.thresholds[i].most(stalk, stalk.came_off)),
         strength.law ? short_number(strength.law->law.most(stalk, stalk.came_off)) : ""});
  }
  page.table({"trial", "fruit", "came off (s)", "load over thresholds", "load over the law"}, rows);
}

void add_noise(io::HtmlReport& page, const Diagnosis& d) {
  page.heading("Noise and numerics");
  const auto row = [](const std::string& name, const Noise& noise, double scale,
                      const std::string& unit) {
    return std::vector<std::string>{name, short_number(scale * noise.std) + " " + unit,
                                    std::to_string(noise.order()),
                                    short_number(noise.correlation())};
  };
  std::vector<std::vector<std::string>> rows{row("positions", d.position_noise, 1e3, "mm")};
  const auto& trials = d.admission.experiment.trials;
  if (std::ranges::any_of(trials, [](const Trial& trial) { return trial.force.size() > 0; }))
    rows.push_back(row("forces", d.force_noise, 1.0, "N"));
  page.table({"noise of", "standard deviation", "autoregressive order", "lag-one correlation"},
             rows);
  page.key_values(
      {{"nodes every", short_number(1e3 * d.numerics.distance) + " mm"},
       {"time step", short_number(1e3 * d.numerics.dt) + " ms"},
       {"own numerical error",
        short_number(d.numerical_error) + " of the noise (RMS), before it was corrected for"}});
}

void add_parameters(io::HtmlReport& page, const Diagnosis& d) {
  page.heading("Parameters");
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, estimate] : d.verdict.parameters)
    rows.push_back({name, estimate_text(estimate)});
  for (const NamedCause& cause : d.verdict.causes)
    for (const auto& [name, estimates] : cause.parameters)
      rows.push_back({cause.name + ", " + name, estimate_text(estimates)});
  for (const auto& [name, estimate] : d.verdict.ratios)
    rows.push_back(
        {name + ", times the file's (only this ratio is seen closely)", estimate_text(estimate)});
  for (const std::string& name : d.unseen) rows.push_back({name, "these data cannot see it"});
  if (!rows.empty()) page.table({"parameter", "value"}, rows);
  if (d.best.why != "not run")
    page.paragraph("The last fit " + std::string(d.best.converged ? "converged" : "stopped early") +
                   " (" + d.best.why + "), condition number " + short_number(d.best.condition) +
                   ".");
}

}  // namespace

std::string report_text(const Experiment& experiment, const Diagnosis& diagnosis) {
  const ReportData report(diagnosis);
  const std::vector<SymptomPair> pairs = symptom_pairs(report);
  const Verdict& v = diagnosis.verdict;
  const std::string title = experiment.title.empty() ? "Diagnosis" : experiment.title;
  io::HtmlReport page(title, "What the simulation of this experiment gets wrong: " +
                                 std::to_string(experiment.trials.size()) + " trials, " +
                                 std::to_string(v.simulations) + " simulations, " +
                                 short_number(v.seconds) + " s");
  add_card(page, report, pairs);
  if (report.predicted) {
    add_paths(page, report);
    add_maps(page, report);
    add_symptoms(page, report, pairs);
  }
  add_ranking(page, diagnosis);
  if (report.predicted) add_gain(page, diagnosis);
  add_detachments(page, diagnosis.strength);
  add_data(page, experiment, diagnosis);
  if (v.outcome != Outcome::bad_data) {
    add_noise(page, diagnosis);
    add_parameters(page, diagnosis);
  }
  if (!diagnosis.steps.empty()) {
    page.heading("What was done");
    page.list(diagnosis.steps);
  }
  return page.text();
}

std::string write_next(const std::filesystem::path& folder, const NextExperiment& next) {
  if (!next.experiment) return {};
  const Experiment& plan = *next.experiment;
  const std::filesystem::path into = folder / "next";
  write_experiment(into, plan);
  const Trial& trial = plan.trials.front();
  const auto write = [&](const std::string& file, const std::string& text) {
    io::write_file_atomically(into / trial.name / file, text);
  };
  for (std::size_t m = 0; m < next.predictions.size(); ++m) {
    const Prediction& predicted = next.predictions[m];
    write("predicted_" + next.names[m] + ".csv",
          points_text(marker_columns(plan.markers), {trial.markers.time, predicted.markers}));
    if (trial.force.size() > 0)
      write("predicted_force_" + next.names[m] + ".csv",
            points_text({"fx", "fy", "fz"}, {trial.force.time, predicted.force}));
  }
  write("predictions.svg", prediction_plot(next));
  return "next/experiment.yaml";
}

void write_report(const std::filesystem::path& folder, const Experiment& experiment,
                  const Diagnosis& diagnosis) {
  io::write_file_atomically(folder / "report.html", report_text(experiment, diagnosis));
}

}  // namespace pedicel::discrepancy
