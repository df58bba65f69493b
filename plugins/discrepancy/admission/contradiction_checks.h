#pragma once

#include <optional>
#include <string>

#include "plugins/discrepancy/admission/nominal_plant.h"
#include "plugins/discrepancy/data/experiment.h"

/// What one trial may contradict. Each check has a file of its own, with the reason for its limits.
/// None of them simulates.
///
/// Known effects stay findings: a latency of 0.3 s, a frame turned by 0.3 rad, a scale of 0.8 to
/// 1.2, a marker that sits 0.05 m aside, a slip of a tenth of the plant. Limits are beyond all of
/// these (largest_known), and beyond what a plant ten times as soft as stated does.
namespace pedicel::discrepancy {

/// The largest that the effects of measurement are taken for.
struct largest_known {
  static constexpr double latency = 0.3;   // s
  static constexpr double rotation = 0.3;  // rad
  static constexpr double scale = 0.2;     // of 1
  static constexpr double offset = 0.05;   // m
  static constexpr double slip = 0.1;      // of the plant's reach
};

struct TrialView {
  const Experiment& experiment;
  const Trial& trial;
  const NominalPlant* nominal_plant;  ///< null: the plant cannot be built
};

struct Fault {
  std::filesystem::path file;  ///< in the trial's folder
  std::string what;            ///< after the file's name
};
using Check = std::optional<Fault>(const TrialView&);

Check check_copies;       ///< tables that are another trial's
Check check_clock;        ///< tables that begin, end or tick on a clock of their own
Check check_units;        ///< markers that are not in metres
Check check_frame;        ///< axes or an origin that are not the plant's
Check check_labels;       ///< markers that are not where their names belong
Check check_slips;        ///< one marker aside at once, and alone
Check check_holds;        ///< paths that are not those of the held points
Check check_drive;        ///< motion on another clock than what is done
Check check_releases;     ///< what is held too long or not long enough
Check check_rate;         ///< clocks that run a little fast beside what is led stiffly
Check check_paths;        ///< motion that is not what is done
Check check_jumps;        ///< free motion with a gap that the clock hides
Check check_frame_steps;  ///< all markers aside by the same, at once
Check check_loads;        ///< motion that is not the loads', in time, way or size
Check check_force_clock;  ///< forces on a clock of their own
Check check_force;        ///< forces that are not newtons, or not the holder's

}  // namespace pedicel::discrepancy
