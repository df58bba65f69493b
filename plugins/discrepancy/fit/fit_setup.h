#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "plugins/discrepancy/fit/numerics.h"

namespace pedicel::discrepancy {

/// An experiment made ready for fits: its noise, its trials to fit and to check, and a simulator at
/// a mesh and a step, with the corrections of their error once that is known.
class FitSetup {
 public:
  /// Keeps references to the experiment, which has been admitted, and to the settings. Everything
  /// that is simulated ends early once `stop` (may be null) is set. The noise is estimated from the
  /// data themselves.
  FitSetup(const Experiment& experiment, int threads, const NoiseRule& rule,
           const std::atomic<bool>* stop, const DiagnosisSettings& settings);

  const Experiment& experiment() const { return *experiment_; }
  const DataSet& data() const { return data_; }
  const FitOptions& options() const { return options_; }  ///< of the trials to be fitted
  const std::vector<int>& check_trials() const { return check_; }
  const Numerics& numerics() const { return numerics_; }
  const Corrections* corrections() const { return corrections_.empty() ? nullptr : &corrections_; }
  const std::atomic<bool>* stop() const { return stop_; }
  bool stopped() const { return stop_ && *stop_; }
  int threads() const { return threads_; }
  /// Entries of the fitted trials that hold a sample.
  int samples() const { return data_.samples(options_.trials); }
  long simulations() const { return simulations_ + simulator_->simulations(); }

  /// On all threads; valid until the next renew(), refine() or correct_at().
  Evaluator evaluator();
  Simulator& simulator() { return *simulator_; }  ///< likewise
  /// Of all trials, [hypothesis][trial].
  std::vector<std::vector<Prediction>> predictions(std::span<const Hypothesis> hypotheses);
  /// A fresh simulator, which has kept no motions.
  void renew();
  /// The noise from what a model leaves of the data, and how its trials answer to a beginning in
  /// motion.
  void renew_noise(const Hypothesis& model);

  struct Watch {
    std::function<void(int round)> begin;
    std::function<void(const NumericsCheck&)> too_coarse;  ///< and will be refined
  };
  /// Refines mesh and step until our own error is a small part of the noise, or until that costs
  /// too much, refits `model` at each, and keeps the corrections of the last check, which is
  /// returned.
  NumericsCheck refine(FitSummary& model, const Watch& watch);
  /// The corrections anew, about a model that is far from the one they were taken at; refines mesh
  /// and step where they are too coarse for it.
  void correct_at(const FitSummary& model);

 private:
  const Accuracy& accuracy() const { return settings_->accuracy; }
  bool is_coarse(const Numerics& numerics) const;
  bool is_fine_enough(const NumericsCheck& check) const;
  Numerics finer(const NumericsCheck& check) const;

  const Experiment* experiment_;
  const DiagnosisSettings* settings_;
  DataSet data_;
  NoiseRule rule_;
  FitOptions options_;
  std::vector<int> check_;
  Numerics numerics_;
  Corrections corrections_;
  int threads_;
  const std::atomic<bool>* stop_;
  std::unique_ptr<Simulator> simulator_;
  long simulations_ = 0;  // of simulators that are gone
};

}  // namespace pedicel::discrepancy
