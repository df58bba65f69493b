#pragma once

#include <chrono>
#include <optional>

#include "plugins/discrepancy/procedure/baseline.h"
#include "plugins/discrepancy/procedure/cause_search.h"
#include "plugins/discrepancy/procedure/deadline.h"
#include "plugins/discrepancy/procedure/verdict_writer.h"

namespace pedicel::discrepancy {

/// One diagnosis on its way from the data to the verdict; inside of diagnose() alone.
class Procedure {
 public:
  /// Keeps a reference to the experiment and to the deadline, which the options' `stop` follows.
  Procedure(const Experiment& experiment, const DiagnosisOptions& options, Deadline& deadline)
      : state_(experiment, options), deadline_(deadline) {}

  /// Once.
  Diagnosis run();

  /// With another trial held out, where the diagnosis should begin anew.
  const std::optional<Experiment>& exchanged() const { return exchanged_; }

 private:
  void search();
  void decide();
  bool exchanges(int objecting);
  Diagnosis finished();

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  DiagnosisState state_;
  Deadline& deadline_;
  ModelCheck check_{state_};
  Baseline baseline_{state_, check_};
  ForceSearch force_{state_, check_};
  CauseSearch causes_{state_, check_, force_};
  VerdictWriter verdict_{state_, check_, force_};
  std::optional<Experiment> exchanged_;
};

}  // namespace pedicel::discrepancy
