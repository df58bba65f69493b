#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/test/symptoms.h"

namespace pedicel::discrepancy {

/// What the plots of a report are drawn from: the admitted data and the models' predictions.
struct ReportData {
  const Experiment& experiment;  ///< as admitted
  const Diagnosis& diagnosis;
  DataSet data;
  bool predicted = false;  ///< there are predictions of all three models for all trials
  bool extended = false;   ///< the third model is another one than the second

  explicit ReportData(const Diagnosis& diagnosis);
  const Prediction& prediction(Model model, int trial) const {
    return diagnosis.predictions[model][trial];
  }
};

/// One channel, by its column in DataSet::scaled_residual().
struct ReportChannel {
  int trial = 0, column = 0;
  double size = 0.0;  ///< what it was chosen by
};

/// The channel of a trial that moves most (m), and the one with the largest residual of a model
/// (noise units).
std::optional<ReportChannel> liveliest(const ReportData& report, int trial);
std::optional<ReportChannel> worst(const ReportData& report, int trial, Model model);
/// Over all trials.
std::optional<ReportChannel> worst(const ReportData& report, Model model);

/// Measured with its noise band (twice the standard deviation) against the models.
std::string path_plot(const ReportData& report, const ReportChannel& channel);
/// Residual of the refitted and the extended model with the noise band.
std::string residual_plot(const ReportData& report, const ReportChannel& channel, int width);
/// RMS residual over markers and time in noise units.
std::string residual_map(const ReportData& report, int trial, Model model);
/// Empty where the symptom has no plot.
std::string symptom_plot(const Symptom& symptom, const std::string& model);
/// RMS residual over the noise floor of the models, as bars; fitted and held-out trials.
std::string error_bars(const Errors& errors, const std::string& title);
/// What the competing models predict for the experiment that would separate them.
std::string prediction_plot(const NextExperiment& next);

}  // namespace pedicel::discrepancy
