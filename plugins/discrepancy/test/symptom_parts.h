#pragma once

#include "plugins/discrepancy/data/places.h"
#include "plugins/discrepancy/test/projection.h"
#include "plugins/discrepancy/test/symptoms.h"

namespace pedicel::discrepancy {

/// What the finders of symptoms share.
struct SymptomContext {
  const Experiment& experiment;
  const DataSet& data;
  const std::vector<Prediction>& predictions;
  std::vector<MarkerChain> chains;

  int trials() const { return static_cast<int>(experiment.trials.size()); }
  int markers() const { return static_cast<int>(experiment.markers.size()); }
  const Trial& trial(int t) const { return experiment.trials[t]; }
  /// Whether the trial has a whole prediction.
  bool usable(int t) const;
  /// m, measured less predicted, of column 3 marker + coordinate.
  Series residual(int t, int column) const;
  /// Velocity of the predicted markers, m/s: of the plant itself where the prediction has it, else
  /// by differences.
  Eigen::MatrixXd velocity(int t) const;
};

/// A time at which a trial's drive jumps, and whether the plant swings freely from there to `to`.
struct Span {
  double from = 0.0, to = 0.0;  ///< s
  bool free = false;            ///< nothing moves it; a hand or a base at rest may hold it
};
/// The stretches of a trial between its jumps.
std::vector<Span> spans_of(const Trial& trial);

/// A stretch of samples in which the predicted plant rests, with the mean residual of every marker.
struct StaticStretch {
  int trial = 0, from = 0, to = 0;  ///< samples from <= i < to
  Eigen::VectorXd mean;             ///< m, 3 markers; NaN where not seen
  Eigen::VectorXd error;            ///< m
  Eigen::VectorXd position;         ///< m, predicted mean
};
std::vector<StaticStretch> static_stretches(const SymptomContext& context);
/// The same of samples from <= i < to, whatever moves there: what does widens the error.
StaticStretch stretch_of(const SymptomContext& context, int t, int from, int to);
/// "weights, 12 to 16 s"
std::string stretch_name(const SymptomContext& context, const StaticStretch& stretch);

/// By how much a trial's markers come late, and by which frequency it mostly moves.
struct TrialDelay {
  int trial = 0;
  double frequency = 0.0;  ///< Hz
  Measured delay;          ///< s
};
/// Of the trials in which something moves.
std::vector<TrialDelay> trial_delays(const SymptomContext& context);

void add_static_symptoms(const SymptomContext& context, std::vector<Symptom>& out);
void add_motion_symptoms(const SymptomContext& context, std::vector<Symptom>& out);
void add_oscillation_symptoms(const SymptomContext& context, std::vector<Symptom>& out);
void add_force_symptoms(const SymptomContext& context, std::vector<Symptom>& out);
void add_sensor_symptoms(const SymptomContext& context, std::vector<Symptom>& out);
/// After the others, which it looks at.
void add_course_symptoms(const SymptomContext& context, std::vector<Symptom>& out);

/// With the rest left to fill in.
Symptom make_symptom(std::string name, std::string subject, double value, double standard_error);

/// "0.83", three digits.
std::string short_number(double value);

}  // namespace pedicel::discrepancy
