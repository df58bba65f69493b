#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/scene_procedure/scene_diagnosis.h"

namespace pedicel::app {

/// What a diagnosis found out, in sentences, in the order in which a person asks.
struct DiagnosisCard {
  struct Cause {
    std::string name, place, numbers;  ///< "spring at the root", "the root", "stiffness 0.81 ..."
    std::string because;
    double evidence = 0.0;  ///< nats
  };
  struct CompetingModel {
    std::string name, why;  ///< why it lost
    double behind = 0.0;    ///< nats
  };

  bool good = false;  ///< adequate or named: something may be concluded
  std::string outcome, headline, certainty;
  std::string remainder;  ///< what is still unexplained, as sentences; may be empty
  std::vector<Cause> causes;
  std::string gain;
  std::vector<CompetingModel> competing_models;
  std::vector<std::string> detectable_limits;  ///< sizes below which it would not have been seen
  std::vector<std::string> unseen;             ///< causes that these data cannot see at all
  std::string next;                            ///< what to do next; never empty
};

DiagnosisCard card_of(const discrepancy::Diagnosis& diagnosis);
/// The same of a measured scene; models that lost have no nats of their own there.
DiagnosisCard card_of(const discrepancy::SceneDiagnosis& diagnosis);

}  // namespace pedicel::app
