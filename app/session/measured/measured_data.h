#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pedicel/app/session/measured/diagnosis_job.h"
#include "pedicel/app/session/measured/model_paths.h"
#include "pedicel/app/session/measured/path_runs.h"
#include "pedicel/discrepancy/procedure/diagnosis.h"

namespace pedicel::app {

/// "nominal", "refitted", "extended".
const char* model_name(discrepancy::Model model);

/// A measured experiment beside the session's document: what was measured, what the models say of
/// it, and a diagnosis. Simulations and diagnoses run on threads of their own; nothing waits for
/// them. All calls from one thread.
class MeasuredData {
 public:
  MeasuredData();
  /// Asks what runs to stop, and waits for it.
  ~MeasuredData();

  /// Takes an experiment in place of the one before, and begins to simulate it with the nominal
  /// plant.
  void open(discrepancy::Experiment experiment);
  void close();
  /// Null: none is open.
  const discrepancy::Experiment* experiment() const { return experiment_.get(); }
  /// Grows when another experiment was opened or this one closed.
  int number() const { return number_; }
  /// Of shape_of() the experiment's plant.
  const std::vector<ShapeCurve>& shape() const { return shape_; }

  /// Null: not known, or not yet.
  const TrialPath* path(discrepancy::Model model, int trial) const;
  /// Whether a model has anything to show.
  bool has(discrepancy::Model model) const;
  /// Trials of models that are still being simulated.
  int still_simulated() const;

  /// Throws UsageError without an experiment, or where a diagnosis runs already. `threads` 0: all
  /// cores but one, which the picture keeps.
  void start_diagnosis(int threads = 0, std::uint64_t seed = 1);
  /// Asks it to stop; nothing where none runs.
  void cancel_diagnosis();
  bool is_diagnosing() const { return diagnosing_ != nullptr; }
  bool is_cancelling() const { return diagnosing_ && diagnosing_->is_cancelled(); }
  DiagnosisProgress progress() const;
  /// The last one that came to an end; null: none did.
  const discrepancy::Diagnosis* diagnosis() const { return diagnosis_.get(); }
  /// The plant with what was found; nothing where nothing was that belongs to the plant.
  std::optional<plant::PlantFile> extended_plant() const;

  /// Takes over what the threads have made; once a frame. What they could not do, a line each.
  std::vector<std::string> update();
  /// Waits until nothing runs any more (scripts, tests).
  std::vector<std::string> wait();

 private:
  using Job = DiagnosisJob<discrepancy::Diagnosis>;
  void simulate(const std::vector<discrepancy::Model>& models,
                const std::vector<discrepancy::Variant>& variants,
                const discrepancy::Numerics& numerics);
  void take_paths(std::vector<std::string>& faults);
  void take_diagnosis(std::vector<std::string>& faults);
  void adopt_predictions();
  void retire();

  std::shared_ptr<const discrepancy::Experiment> experiment_;
  int number_ = 0;
  std::vector<ShapeCurve> shape_;
  std::array<std::vector<std::optional<TrialPath>>, discrepancy::model_count> paths_;
  std::shared_ptr<const discrepancy::Diagnosis> diagnosis_;
  PathRuns<TrialPath> runs_;
  std::unique_ptr<Job> diagnosing_;
  std::vector<std::unique_ptr<Job>> retired_;  // asked to stop, not yet ended
};

}  // namespace pedicel::app
