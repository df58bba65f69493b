#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/session/measured/measured_models.h"
#include "app/session/measured/model_paths.h"
#include "plugins/discrepancy/procedure/diagnosis.h"

namespace pedicel::app {

/// "nominal", "refitted", "extended".
const char* model_name(discrepancy::Model model);

/// A measured experiment of a plant: what the models say of it, and a diagnosis.
class MeasuredData final
    : public MeasuredModels<discrepancy::Experiment, TrialPath, discrepancy::Diagnosis> {
 public:
  /// Takes an experiment in place of the one before, and begins to simulate it with the nominal
  /// plant.
  void open(discrepancy::Experiment experiment);
  void close();
  /// Of shape_of() the experiment's plant.
  const std::vector<ShapeCurve>& shape() const { return shape_; }

  /// Throws UsageError without an experiment, or where a diagnosis runs already. `threads` 0: all
  /// cores but one, which the picture keeps.
  void start_diagnosis(int threads = 0, std::uint64_t seed = 1);
  /// The plant with what was found; nothing where nothing was that belongs to the plant.
  std::optional<plant::PlantFile> extended_plant() const;

 private:
  void run(const std::vector<discrepancy::Model>& models,
           const std::vector<discrepancy::Variant>& variants,
           const discrepancy::Numerics& numerics);
  void take_path(std::optional<TrialPath>& place, TrialPath path) override;
  void adopt_diagnosis() override;

  std::vector<ShapeCurve> shape_;
};

}  // namespace pedicel::app
