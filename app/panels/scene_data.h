#pragma once

#include <vector>

#include "app/session/measured/scene_instant.h"
#include "app/ui/plot.h"
#include "app/ui/ui.h"

namespace pedicel::app {

/// The part of the panel Data that is about a measured run of a robot at plants: models, what each
/// instrument says against them, one column over time, and the camera to look through.
class SceneData {
 public:
  void draw(Ui& ui);
  /// Another trial: the plot shows all of it.
  void follow() { plot_.follows = true; }

 private:
  void models(Ui& ui) const;
  void instruments(Ui& ui, const std::vector<SceneInstrument>& list);
  void plot(Ui& ui, const SceneInstrument& instrument);
  static void shown(Ui& ui);

  PlotView plot_;
};

}  // namespace pedicel::app
