#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plugins/effects/registry/free_parameter.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::discrepancy {

enum class Outcome { adequate, named, ambiguous, unknown, bad_data, numerical };
std::string to_string(Outcome outcome);
/// Exit code of `pedicel diagnose`: 0 adequate, 10 to 14 the others.
int exit_code(Outcome outcome);

/// A number with its 95 % interval; infinite ends are left open (null in the file).
struct Estimate {
  double value = 0.0, low = 0.0, high = 0.0;
  std::string unit;
};

/// A number of the trials that were fitted, and of those held out; absent where there is none.
struct FitAndCheck {
  std::optional<double> fit, check;
};
/// RMS of what a cause changes, over all trials.
struct Change {
  std::optional<double> marker;    ///< m
  std::optional<double> force;     ///< N
  std::optional<double> moment{};  ///< N m, at the root
  std::optional<double> pixel{};   ///< px
};

struct NamedCause {
  std::string name;
  std::string plain{};  ///< for sentences; empty: as its effect says it
  std::map<std::string, std::vector<Estimate>> parameters;  ///< one entry a component
  std::optional<plant::CurvePlace> where;
  std::map<std::string, std::string> words;  ///< which marker, which trial
  std::string because;                       ///< one sentence
  double evidence = 0.0;  ///< log-likelihood gained, less what its parameters cost
  /// Part of the nominal misfit above the noise that it takes away (tell_shares()).
  FitAndCheck share;
  Change change;
  std::string against;  ///< of one that came near: what speaks against it
  /// Under `ambiguous`, beside causes that are certain: the one in whose place it would stand.
  /// Empty for all others, and where nothing is certain.
  std::string instead_of{};
};

/// What acts from outside, and no known cause is.
struct OutsideAction {
  Vec3 position = Vec3::Zero();  ///< m, W
  std::string plant;             ///< name; empty where there is one only
  plant::CurvePlace place;
  double from = 0.0, to = 0.0;    ///< s
  Vec3 direction = Vec3::Zero();  ///< unit, W: towards where it pulls
};

struct CompetingModel {
  std::string name;
  double behind = 0.0;  ///< of the evidence
};

/// RMS residual over the noise floor; absent where there were no such trials.
struct Errors {
  std::optional<double> nominal, refitted, extended;
};

/// What the verdict's model leaves of the data: the one with its causes, or the refitted one where
/// nothing is named.
struct LeftMisfit {
  struct Channel {
    std::string name;  ///< kind of instrument: "position", "force"
    std::optional<double> times_noise, share;
  };
  FitAndCheck share{};                  ///< of what the refitted model leaves above the noise
  FitAndCheck times_noise{};            ///< RMS residual over the noise of a sample
  std::vector<Channel> channels{};      ///< over all trials
  std::vector<std::string> symptoms{};  ///< names of those that still show
};

struct DetectableLimit {
  std::string name, parameter;
  double smallest = 0.0;
  std::string unit;
  /// Where the effect does nothing, for effects of scenes; those of plants are known by their name.
  effects::Vanishes vanishes = effects::Vanishes::never;
};

/// A respect in which the data differ from the refitted model: measured less simulated.
struct SymptomNumber {
  std::string name, of;             ///< `of`: the trial, marker or curve; empty: all of them
  double value = 0.0, error = 0.0;  ///< standard error
  std::string unit;
  bool shows = false;  ///< beyond chance
  std::vector<std::string> speaks_for;
  std::string sentence;
};

/// What verdict.json says: the page Verdict of the manual.
struct Verdict {
  Outcome outcome = Outcome::adequate;
  std::vector<NamedCause> causes;   ///< what explains most first; under `ambiguous` likeliest first
  std::vector<NamedCause> details;  ///< real, and too small to matter
  std::vector<NamedCause> nearest;  ///< under `unknown`: what came closest
  std::vector<SymptomNumber> symptoms;  ///< the clearest of each kind first
  std::vector<CompetingModel> competing;
  std::map<std::string, Estimate> parameters;
  /// "youngs_modulus/density": of the factors on the two, where the data see it far more closely
  /// than either.
  std::map<std::string, Estimate> ratios;
  Errors fit, check;
  std::optional<double> gain;               ///< over the refitted model, on held-out trials
  std::optional<double> gain_over_nominal;  ///< likewise
  std::string remainder;
  LeftMisfit left;
  std::optional<OutsideAction> unknown{};  ///< under Outcome::unknown, where it was found
  std::vector<DetectableLimit> detectable_limits;
  std::string next_experiment;
  std::string extended_plant;    ///< file name, empty where there is none
  std::string extended_scene{};  ///< likewise
  std::string next;              ///< file of the experiment that decides; empty where there is none
  bool partial = false;          ///< the search was cut short
  bool refit_misleads = false;   ///< the refit makes the held-out trials worse
  long simulations = 0;
  double seconds = 0.0;
};

std::string to_json(const Verdict& verdict);
/// How much of the error above the noise a gain removes: "96 %", or "all" where noise alone is
/// left.
std::string share_removed(double gain);
/// "contact that is too smooth (contact_friction)".
std::string said_name(const NamedCause& cause);
/// "Something holds branch_1 at (0.21, 0.03, 0.34) m from 1.2 s on, pulling towards -x."
std::string outside_sentence(const OutsideAction& action);
/// One sentence: what is wrong and how sure that is.
std::string headline(const Verdict& verdict);

}  // namespace pedicel::discrepancy
