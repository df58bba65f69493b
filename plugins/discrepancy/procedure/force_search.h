#pragma once

#include <optional>

#include "plugins/discrepancy/procedure/model_check.h"

namespace pedicel::discrepancy {

/// The force that is missing where no known cause explains the data. Slow, so it is sought once.
class ForceSearch {
 public:
  /// Keeps references.
  ForceSearch(DiagnosisState& state, ModelCheck& check) : state_(state), check_(check) {}

  /// Where, when and of what kind it is; none where even a free one scores less than
  /// `least_evidence` (nats). `from` is the share of the whole diagnosis that is done.
  const MissingForce& find(double from, double least_evidence = 0.0);

 private:
  DiagnosisState& state_;
  ModelCheck& check_;
  std::optional<MissingForce> force_;
};

}  // namespace pedicel::discrepancy
