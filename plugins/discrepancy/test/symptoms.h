#pragma once

#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/simulate/data_set.h"

namespace pedicel::discrepancy {

/// A curve to draw beside a symptom.
struct SymptomSeries {
  std::string label;
  std::vector<double> x, y;
  bool line = true;  ///< else points
};

/// What to draw; empty where there are no series.
struct SymptomPlot {
  std::string title, x_label, y_label;  ///< labels with their units
  std::vector<SymptomSeries> series;
};

/// How the data differ from a model in one respect: measured less simulated, 0 where they agree.
struct Symptom {
  std::string name;     ///< "base_rotation"
  std::string subject;  ///< the trial, marker or curve it is about; empty: all of them
  double value = 0.0;
  double standard_error = 0.0;          ///< from the noise alone
  double least = 0.0;                   ///< size below which nothing else would be said of it
  std::string unit;                     ///< "1" where it has none
  std::string sentence;                 ///< in plain words, with the numbers
  std::vector<std::string> speaks_for;  ///< causes that would make it
  SymptomPlot plot;

  /// Beyond chance: 5 standard errors, which all symptoms of an experiment together (about 100,
  /// some the lengths of vectors of three) reach in less than 1 % of null cases.
  bool shows() const;
  /// The value in standard errors.
  double significance() const;
};

/// All symptoms that the data of the trials can show, for the predictions of one model (one a
/// trial). What a kind of test cannot show is left out; trials whose prediction failed are, too.
std::vector<Symptom> symptoms(const Experiment& experiment, const DataSet& data,
                              const std::vector<Prediction>& predictions);

/// The same symptom of two models, for a table: of each name the subject that is strongest before.
struct SymptomPair {
  Symptom before, after;
};
std::vector<SymptomPair> paired(const std::vector<Symptom>& before,
                                const std::vector<Symptom>& after);

/// "0.83 ± 0.02 mm": both to the same decimal, by the error's size.
std::string with_error(double value, double error, const std::string& unit);

}  // namespace pedicel::discrepancy
