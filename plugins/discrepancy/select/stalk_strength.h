#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugins/discrepancy/settings/diagnosis_settings.h"
#include "plugins/discrepancy/simulate/stalk_loads.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

/// When stalks break: where their load, in units of what they bear, reaches their strength;
/// strengths are log-normal about 1. With an exponent p the load is
/// ((N/force)^p + (M/moment)^p + (T/torsion)^p)^(1/p), the effect `detachment_law`; an infinite p
/// is a threshold on each of the five: the largest ratio counts.
struct BreakLaw {
  StalkNumbers scale;  ///< infinite: takes no part
  double exponent = std::numeric_limits<double>::infinity();
  double scatter = 0.1;  ///< 1, standard deviation of the logarithm of the strengths

  BreakLaw() { scale.fill(std::numeric_limits<double>::infinity()); }
  double load(const StalkNumbers& load) const;
  /// The largest up to a time (s).
  double most(const StalkLoads& stalk, double until) const;
};

/// The thresholds of a fruit, or the detachment law that the plant file has in place of them (of
/// unequal exponents the largest stands for all).
BreakLaw break_law_of(const plant::PlantFile& plant, const plant::PlantFruit& fruit);

/// A law of breaking as fitted to events by maximum likelihood.
struct FittedLaw {
  BreakLaw law;
  /// Standard deviations of the logarithms of the scales; when in its window a break happens is
  /// part of them.
  StalkNumbers error{};
  double likelihood = 0.0;  ///< log probability of the events
  double evidence = 0.0;    ///< less half the logarithm of the stalks a free number (BIC)
};

/// What the times at which fruits came off say about the plant file's thresholds.
struct StalkStrength {
  std::vector<StalkLoads> stalks;    ///< of all trials
  std::vector<BreakLaw> thresholds;  ///< the file's, by stalk
  Levels levels = {};                ///< that the law is held against
  int broken = 0;                    ///< stalks
  double scatter = 0.0;              ///< about the thresholds, 1
  std::optional<FittedLaw> law;      ///< the best; absent where too few broke
  /// By how much the events speak for the law, against the thresholds (nats): all of them, and
  /// each foretold by a fit to the others.
  double evidence = 0.0, foretold = 0.0;

  /// Whether the law stands for events that the thresholds do not explain.
  bool needs_law() const;
  /// How far from the thresholds the fruits came off, and how much nearer to the law.
  std::string sentence() const;
  /// The same with the evidence, whatever it says.
  std::string summary() const;
};

/// The likelihood of a break is the probability that it happened within `window` (s) before it was
/// seen, that of a stalk that held the probability that it bore its trial. What a law cannot
/// explain costs 14 nats a break, not all. Thresholds may all be off by one factor, known to 10 %:
/// as far as that explains the events they are no finding.
StalkStrength judge_strength(std::vector<StalkLoads> stalks, std::vector<BreakLaw> thresholds,
                             double window, const DiagnosisSettings& settings);

}  // namespace pedicel::discrepancy
