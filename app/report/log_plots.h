#pragma once

#include <limits>
#include <string>
#include <vector>

#include "engine/io/csv.h"
#include "engine/plots/svg_plot.h"

namespace pedicel::app {

/// The limits of a fruit's stalk that are drawn beside its strain; infinite: none.
struct StalkLimits {
  std::string fruit;                                         ///< "truss/fruit_3"
  double stretch = std::numeric_limits<double>::infinity();  ///< 1
  double bend = std::numeric_limits<double>::infinity();     ///< rad
};

/// The plots of a run's log.csv that matter: how near the fruits were to coming off, strain of
/// their stalks against the limits, contact force of the links and bodies that touched the plant,
/// heights of tool and fruits; for a plant without fruits its largest strain and kinetic energy.
/// Shows the fruits that came nearest to their limits and the links that pressed most. `events`
/// are marked in all. A column that is not there is left out.
std::vector<plots::LinePlot> log_plots(const io::CsvTable& log,
                                       const std::vector<StalkLimits>& limits,
                                       const std::vector<plots::PlotEvent>& events);

/// A measured quantity over the values of a sweep; `label` and `measured_label` carry their units.
plots::LinePlot sweep_plot(const std::string& label, const std::vector<double>& values,
                           const std::string& measured_label, const std::vector<double>& measured);

}  // namespace pedicel::app
