#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "plugins/discrepancy/simulate/data_set.h"
#include "plugins/discrepancy/simulate/hypothesis.h"

namespace pedicel::discrepancy {

/// A trial that would tell competing explanations apart, and what each of them predicts for it.
struct NextExperiment {
  std::string sentence;            ///< what to do and what will be seen; empty: nothing found
  std::string channel;             ///< "m3.x" or "force.x", where they differ most
  std::string unit;                ///< of the series
  std::vector<std::string> names;  ///< of the hypotheses
  std::vector<double> time;        ///< s
  std::vector<std::vector<double>> series;  ///< m or N, one a hypothesis
  double noise = 0.0;                       ///< m or N, standard deviation of a sample
  double separation = 0.0;  ///< noise units in all: root of the whitened sum of squares
  double minutes = 0.0;     ///< of work that it takes
  /// The trial itself, with sample times and nothing measured (NaN), on the plant as it stands; and
  /// what each model predicts for it. Absent where nothing was found, or the plant is to be turned.
  std::optional<Experiment> experiment;
  std::vector<Prediction> predictions;
};

struct NextExperimentOptions {
  Numerics numerics;
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;  ///< what is found is not to be used once it is set
  DiagnosisSettings settings = {};
};

/// Simulates a handful of trials that can be done on the same plant for each of the hypotheses
/// (likeliest first), and chooses the one that separates the first one best from its nearest
/// competing model for the time it takes. `simulations` counts what was simulated.
NextExperiment next_experiment(const Experiment& experiment, const DataSet& data,
                               const std::vector<Hypothesis>& models,
                               const NextExperimentOptions& options, long& simulations);

/// Where none of the known causes explains the data: which trial to repeat with other amplitudes,
/// and where to look closer. `predictions`: of the refitted model.
NextExperiment next_look(const Experiment& experiment, const DataSet& data,
                         const std::vector<Prediction>& predictions);

}  // namespace pedicel::discrepancy
