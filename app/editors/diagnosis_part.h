#pragma once

#include <optional>

#include "app/session/measured/diagnosis_card.h"

namespace pedicel::app {

struct Ui;

/// The part of the panel of measured data that is about the diagnosis: start, progress and cancel,
/// then the card with the competing models and what to do next.
class DiagnosisPart {
 public:
  /// The button that begins it, or how far it is.
  void draw(Ui& ui);
  /// Its card; nothing before there is one.
  void draw_result(Ui& ui);

 private:
  void draw_progress(Ui& ui);
  void draw_card(Ui& ui);
  void draw_causes(Ui& ui);
  void draw_competing_models(Ui& ui);
  void draw_next(Ui& ui);
  void draw_buttons(Ui& ui);

  int of_ = 0;  // SessionMeasured::diagnoses() that the card is about
  DiagnosisCard card_;
};

}  // namespace pedicel::app
