#pragma once

#include <vector>

#include "plugins/discrepancy/procedure/diagnosis_state.h"

namespace pedicel::discrepancy {

/// What a model leaves unexplained: the directed tests about it, and what they do not look for.
class ModelCheck {
 public:
  /// Keeps a reference.
  explicit ModelCheck(DiagnosisState& state) : state_(state) {}

  /// Searches about this model from now on.
  void anchor_at(const FitSummary& model);
  /// What every cause would change about the model, which is the anchor.
  std::vector<Direction> directions_at(const FitSummary& model);
  /// Whether anything is wrong with the model; the directions get their scores.
  Alarm judged(std::vector<Direction>& directions, const FitSummary& model) const;
  /// Whether nothing is left once the junctions may give a little; then they do in `model`.
  bool explained_by_junctions(const Alarm& before, FitSummary& model);
  /// Whether what is left alarms, but scores too little for another cause.
  bool leaves_little(const Alarm& alarm) const;

 private:
  DiagnosisState& state_;
};

}  // namespace pedicel::discrepancy
