#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/force/missing_force.h"

namespace pedicel::discrepancy {

/// A place where a force was looked for by the linear response, with what was found there.
struct ForcePlace {
  ForceSpace space;
  FreeForce free;
  ForcePath path;
};

/// "stem at 0.8 of its length".
std::string place_text(const plant::CurvePlace& place);

/// The law that a law goes over into when its other end is near: a stop a string, a constant push a
/// spring; empty for others.
std::string kind_with_near_end(const std::string& kind);

/// Laws that the linear response found, refitted together with the model's parameters by the
/// simulator itself, because large forces are not linear.
class ForceRefits {
 public:
  /// `model`: without a force; gains are counted from it. `centre`: the model about which the
  /// linear response was taken. Keeps references to all.
  ForceRefits(Evaluator& evaluator, const FitSummary& model, const FitSummary& centre,
              std::span<const ForcePlace> places, const LibraryScales& scales,
              const MissingForceOptions& options);

  /// Refits what may be the best of `laws`, best first. Once.
  void run(std::vector<ForceTerm> laws);

  /// Those that were refitted, best first.
  const std::vector<ForceTerm>& laws() const { return refitted_; }
  /// The model with the best; "not run" where there is none.
  const FitSummary& best() const { return best_; }

 private:
  std::vector<ForceTerm> worth_refitting() const;
  void refit(ForceTerm law);
  FitSummary fitted(const ForceTerm& law);
  FitSummary moved_along(FitSummary found, const FitOptions& few);
  Hypothesis best_start(const plant::Effect& force);
  Hypothesis with(const plant::Effect& force) const;
  void judge(const FitSummary& found, ForceTerm& law) const;
  std::vector<ForceTerm> close_ones() const;
  std::optional<ForceTerm> with_other_end(const ForceTerm& law) const;
  const ForcePlace& nearest(const plant::CurvePlace& at) const;
  void sort();

  Evaluator& evaluator_;
  const FitSummary& model_;
  const FitSummary& centre_;
  std::span<const ForcePlace> places_;
  const LibraryScales& scales_;
  const MissingForceOptions& options_;
  const Budget& budget_;
  std::vector<ForceTerm> linear_, refitted_;
  double best_evidence_ = 0.0;
  FitSummary best_;
};

}  // namespace pedicel::discrepancy
