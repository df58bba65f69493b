#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/parameter.h"

namespace pedicel::discrepancy {

/// At how much evidence, or how many deviations, something counts.
struct Levels {
  double clear_odds = 3.0;              ///< nats
  double clear_margin = 5.0;            ///< nats
  double outside_evidence = 8.0;        ///< nats
  double worth_naming = 18.0;           ///< nats
  double as_well = 1.0;                 ///< nats
  double one_deviation = 0.5;           ///< nats
  double least_alarm = 5.0;             ///< deviations
  double alarm_quantile = 0.995;        ///< share of data without any effect
  double residual_power = 6.0;          ///< deviations
  double winsorised_at = 4.0;           ///< noise units
  double held_out_deviations = 6.0;     ///< deviations
  double held_out_excess = 0.1;         ///< of the noise's square
  double held_out_worse = 1.05;         ///< of an error
  double impossible_force = 20.0;       ///< times what was measured
  double impossible_refit = 2.0;        ///< the same when it is refitted
  double needed_deviations = 3.5;       ///< deviations
  double least_factor_change = 0.0015;  ///< of a logarithm
  double known_to = 0.01;               ///< of a number
  double least_share = 0.02;            ///< of the misfit
  double believed = 2.0;                ///< deviations
  double prior_conflict = 4.0;          ///< deviations
  double beyond_mesh = 30.0;            ///< noise units in all
  double small_excess = 0.01;           ///< of the noise's square
  double missed_share = 0.1;            ///< of the gain
  double remainder_share = 0.05;        ///< of the excess
  double separating = 6.0;              ///< noise units in all
  double outlier_share = 0.0045;        ///< of all samples
  int outlier_count = 12;
  int broken_stalks = 4;
};

/// How explanations are weighed against each other.
struct Evidence {
  double margin_share = 0.002;            ///< of the gain
  double most_margin = 10.0;              ///< nats
  double most_margins = 3.0;              ///< margins
  double limit_reach = 0.02;              ///< of an unknown
  double solvers_agree = 0.02;            ///< of a change
  double held_out_change = 3.0;           ///< noise units in all
  double held_out_share = 0.2;            ///< of the expected gain
  double held_out_chance = 2.0;           ///< deviations
  double family_share = 0.5;              ///< of the gain
  double beyond_linear = 4.0;             ///< times the gain
  double much_left = 4.0;                 ///< mean square, noise units
  double left_by_force = 1.0 / 3.0;       ///< of what the best cause leaves
  double far_from_data = 2.0;             ///< mean square, noise units
  double beyond_doubt = 300.0;            ///< nats
  double beyond_doubt_together = 3000.0;  ///< nats
  double force_share = 0.05;              ///< of the gain
  double worthwhile_force = 0.5;          ///< of the gain
  double too_alike = 0.95;                ///< cosine
  double discretisation = 0.55;           ///< of a half segment's compliance
  double most_discretisation = 1.5;       ///< of a half segment's compliance
  double stalk_scatter = 0.03;            ///< of a logarithm
  double threshold_error = 0.1;           ///< of a logarithm
  double impossible_break = 1.0e-6;       ///< probability
  int more_numbers = 2;
};

/// What a diagnosis may cost: iterations, starts, candidates.
struct Budget {
  double least_step = 0.05;          ///< nats
  double baseline_horizon = 0.3;     ///< of the records
  double candidate_horizon = 0.35;   ///< of the records
  double rough_step = 1.0;           ///< nats
  double far_behind = 0.3;           ///< of the best gain
  double near_by = 50.0;             ///< nats
  double near_share = 0.05;          ///< of the best gain
  double large_gain = 2000.0;        ///< nats
  double lost_by = 200.0;            ///< nats
  double lost_share = 0.05;          ///< of the best gain
  double lost_early = 0.6;           ///< of the best gain
  double lost_late = 0.3;            ///< of the best gain
  double lost_at_once = 0.9;         ///< of the best gain
  double ladder_tie = 0.5;           ///< nats
  double gust_start = 0.2;           ///< of its mean
  double least_statistic = 1.0;      ///< deviations
  double worth_a_fit = 1.0;          ///< nats
  double continuation_way = 0.5;     ///< deviations
  double continuation_unlike = 0.1;  ///< of a change
  double continuation_step = 0.1;    ///< of a logarithm
  double continuation_hold = 0.02;   ///< of a logarithm
  double continuation_lost = 1.5;    ///< times the base's cost
  double law_evidence = 4.0;         ///< nats
  double law_within = 30.0;          ///< nats
  double law_share = 0.3;            ///< of the best law's evidence
  double law_close_share = 0.05;     ///< of the best law's evidence
  double law_place_share = 0.5;      ///< of the law's evidence
  int iterations = 60;
  int first_iterations = 6;
  int first_led = 6;
  int whole_iterations = 10;
  int size_iterations = 2;
  int place_iterations = 6;
  int extended_iterations = 3;
  int size_starts = 2;
  int extended_starts = 1;
  int special_starts = 3;
  int foremost = 2;
  int leaders = 6;
  int whole_candidates = 8;
  int fine_iterations = 4;
  int linear_starts = 2;
  int threshold_starts = 4;
  int ladder_rungs = 4;
  int ladder_parts = 5;
  int ladder_rounds = 3;
  int place_rounds = 3;
  int instant_rounds = 6;
  int slide_iterations = 10;
  int continuation_starts = 2;
  int continuation_iterations = 3;
  int continuation_steps = 10;
  int screened = 12;
  int causes = 3;
  int bootstraps = 400;
  int junction_iterations = 15;
  int refinements = 4;
  int competing_models = 4;
  int force_places = 14;
  int strong_places = 3;
  int law_refits = 5;
  int law_iterations = 30;
  int law_looks = 6;
  int look_iterations = 5;
  int stop_moves = 3;
};

/// Mesh, step and differences: what our own numbers may err by.
struct Accuracy {
  double allowed_error = 0.15;     ///< of the noise, RMS
  double allowed_coarse = 0.06;    ///< of the noise, RMS
  double masked_error = 0.05;      ///< of what the model leaves, RMS
  double masked_verdict = 0.1;     ///< of what the model leaves, RMS
  double numerical_limit = 0.5;    ///< of the noise, RMS
  double left_uncorrected = 0.1;   ///< of a correction
  double coarse_error = 0.4;       ///< of the noise, RMS
  double coarse_share = 0.05;      ///< of what the model leaves, RMS
  double coarsest_mesh = 2.0;      ///< times the plant file's distance
  double usual_dt = 1.0 / 480.0;   ///< s
  double design_dt = 1.0 / 240.0;  ///< s
  double direction_change = 15.0;  ///< noise units in all
  double most_change = 60.0;       ///< noise units in all
  double full_size = 10.0;         ///< times the size that is looked at first
  double seen = 0.1;               ///< noise units
  double plainly_seen = 0.3;       ///< noise units
  double shift_step = 0.005;       ///< of a logarithm
  double usual_shift = 0.02;       ///< of a logarithm
  double own_amplitude = 2.0;      ///< times our own error
  double least_across = 0.05;      ///< of a unit vector
  double far_end = 0.6;            ///< m a length of the plant
  int quiet_steps = 4;
  int motion_shapes = 4;
  int power_neighbourhood = 10;
};

/// Every number that decides in a diagnosis. The defaults are those of the manual's measurements.
struct DiagnosisSettings {
  Levels levels;
  Evidence evidence;
  Budget budget;
  Accuracy accuracy;
};

/// The settings where a caller has none of its own.
const DiagnosisSettings& default_settings();

/// Where a number comes from: `derived` from theory, `measured` on the project's own bench of
/// hidden effects, or a `budget` of computing time.
enum class SettingKind { derived, measured, budget };
std::string_view to_string(SettingKind kind);

/// One number, described once: `--set`, the manual and the sensitivity table come from this.
struct DiagnosisSetting : Parameter {
  SettingKind kind = SettingKind::measured;
  std::string source;
  std::string doubled;  ///< a sentence: what twice the value does
};

/// All of them, by name ("levels.clear_odds"), as they stand in `settings`, which must outlive
/// them.
std::vector<DiagnosisSetting> described(DiagnosisSettings& settings);

/// Sets one from "levels.clear_odds=4". Throws UsageError, which says what was expected.
void set_setting(DiagnosisSettings& settings, const std::string& assignment);

}  // namespace pedicel::discrepancy
