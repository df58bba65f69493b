#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/settings/diagnosis_settings.h"

namespace pedicel::discrepancy {

/// Which cause of a scene's misfit is looked for, and when a model does.
struct SceneSearchSettings {
  double floor = 0.35;                          ///< noise units, RMS
  double solvers_share = 0.05;                  ///< of the misfit
  double held_out_allowance = 2.0;              ///< times what fitted trials may leave
  double clean_allowance = 2.0;                 ///< times the floor
  double least_gain = 0.06;                     ///< mean square, noise units
  double number_price = 0.007;                  ///< of the mean square beyond the noise
  double tie_share = 0.5;                       ///< of the mean square that the best leaves
  double least_tie = 0.02;                      ///< mean square, noise units
  double behind = 4.0;                          ///< times the best misfit
  double halfway = 0.5;                         ///< of the misfit
  double renewed_share = 0.8;                   ///< of the misfit
  double shorter_step = 0.4;                    ///< of a linear step
  double named_deviations = 3.0;                ///< deviations
  double modulus_known_to = 0.02;               ///< of a logarithm
  double density_known_to = 0.04;               ///< of a logarithm
  double damping_known_to = 0.2;                ///< of a logarithm
  double least_displacement = 1.0e-3;           ///< m
  double farthest_start = 0.016;                ///< m
  double decoy_margin = Levels{}.clear_margin;  ///< nats
  double too_alike = Evidence{}.too_alike;      ///< cosine
  double mesh = 0.02;                           ///< m
  double dt = 2.0e-3;                           ///< s
  double run_dt = 8.0e-3;                       ///< s
  int baseline_iterations = 6;
  int first_iterations = 4;
  int last_iterations = 4;
  int polishing = 3;
  double rest_stretch = 0.2;  ///< s
  int renewals = 3;
  int tried = 16;
  int plant_starts = 16;
  int starts_of_each = 2;
  double left_files = 0.1;  ///< of a logarithm
  int refits = 4;
  int causes = 3;
};

/// Differences of fits, and what is known of a scene beforehand.
struct SceneFitSettings {
  double wanted_change = 30.0;      ///< noise units in all
  double first_step = 0.02;         ///< of an unknown
  double least_step = 1.0e-4;       ///< of an unknown
  double least_place_step = 1.0;    ///< of a unit step, of an unseen plant's place
  double most_step = 0.3;           ///< of an unknown
  double screen_factor_step = 0.1;  ///< of a logarithm
  double screen_step = 1.0;         ///< of a unit step
  double least_gain = 0.5;          ///< nats
  double density_prior = 0.1;       ///< of a logarithm
  double damping_prior = 1.0;       ///< of a logarithm
  double place_known_to = 0.03;     ///< m
  double yaw_known_to = 0.3;        ///< rad
};

/// A force from outside: where it acts, and its course.
struct OutsideForceSettings {
  double spacing = 0.045;           ///< m
  double bin = 0.03;                ///< s
  double rise = 0.05;               ///< s
  double least_response = 1.0e-3;   ///< m
  double most_response = 0.02;      ///< m
  double significant_bin = 2.0;     ///< mean square, noise units
  double clear_force = 5.0;         ///< deviations
  double peak_share = 0.15;         ///< of the largest force
  double onset_share = 0.15 / 3.0;  ///< of the largest force
  double least_share = 0.3;         ///< of the misfit
  double weak_axis = 3.0e-3;        ///< of the response
  int places = 40;
};

/// What wrench and joints alone say of a plant.
struct RobotAloneSettings {
  double least_push = 15.0;        ///< deviations
  double firm_share = 0.9;         ///< of the largest force
  double around_break = 0.012;     ///< s
  double break_window = 0.003;     ///< s
  double break_share = 0.25;       ///< of the largest force
  double break_deviations = 12.0;  ///< deviations
  double line_step = 2.5e-4;       ///< m
  double line_reach = 0.5;         ///< m
  double touching = 1.0e-3;        ///< m
  double near_stem = 0.03;         ///< m
  int places = 80;
};

/// When a symptom of a scene shows, and how it is measured.
struct SceneSymptomSettings {
  double shows_at = 5.0;           ///< deviations
  double still = 0.15;             ///< s
  double clear_push = 10.0;        ///< noise units
  double light_push = 0.08;        ///< of the largest force
  double firm_push = 0.4;          ///< of the largest force
  double smoothing = 0.012;        ///< s
  double slip_ratio = 0.95;        ///< of the largest ratio
  double ratio_known_to = 0.01;    ///< 1
  double slip_known_to = 0.1;      ///< s
  double clock_known_to = 2.0e-4;  ///< s
  double place_known_to = 5.0e-5;  ///< m
  double pixel_known_to = 0.02;    ///< px
  double event_known_to = 0.01;    ///< s
};

/// Every number that decides in the diagnosis of a scene.
struct SceneSettings {
  SceneSearchSettings search;
  SceneFitSettings fit;
  OutsideForceSettings outside;
  RobotAloneSettings robot;
  SceneSymptomSettings symptoms;
};

/// The settings where a caller has none of its own.
const SceneSettings& default_scene_settings();

/// All of them, by name ("search.floor"), as they stand in `settings`, which must outlive them.
std::vector<DiagnosisSetting> described(SceneSettings& settings);

/// Sets one from "search.floor=0.5". Throws UsageError, which says what was expected.
void set_setting(SceneSettings& settings, const std::string& assignment);

/// A sentence for each one that is not as by default.
std::vector<std::string> changed_settings(SceneSettings settings);

}  // namespace pedicel::discrepancy
