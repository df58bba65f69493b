#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plugins/discrepancy/test/statistics.h"

namespace pedicel::discrepancy {

/// Passes on what is done, with shares that never fall: threads report out of turn, and what begins
/// anew goes through stages that it has had. May be called from any thread, one call at a time
/// reaches `to`. Empty where `to` is.
std::function<void(const std::string&, double)> rising(
    std::function<void(const std::string&, double)> to);

/// What a diagnosis says while it runs: its progress, and each finding as a sentence, which is kept
/// for the report.
class DiagnosisLog {
 public:
  /// Both calls may be empty. Keeps a reference to `steps`.
  DiagnosisLog(std::function<void(const std::string&, double)> progress,
               std::function<void(const std::string&)> found, std::vector<std::string>& steps)
      : progress_(std::move(progress)), found_(std::move(found)), steps_(steps) {}

  void say(const std::string& what, double share) const;
  void note(const std::string& sentence);
  /// Those that are not the defaults.
  void settings(DiagnosisSettings settings);
  void noise(const DataSet& data);
  /// A fit's parameters; `samples` were fitted.
  void fit(const std::string& what, const FitSummary& fit, int samples);
  /// The strongest directions.
  void directions(std::vector<Direction> directions, const Alarm& alarm);

 private:
  std::function<void(const std::string&, double)> progress_;
  std::function<void(const std::string&)> found_;
  std::vector<std::string>& steps_;
};

}  // namespace pedicel::discrepancy
