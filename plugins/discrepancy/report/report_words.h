#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugins/discrepancy/procedure/diagnosis.h"

namespace pedicel::discrepancy {

/// "0.81 N m/rad (95 %: 0.77 to 0.86)"; open ends are said.
std::string estimate_text(const Estimate& estimate);
/// The same for the components of a vector, in brackets.
std::string estimate_text(const std::vector<Estimate>& estimates);

/// "at 0.4 of stem", "marker m3", "the root": empty where it has no place of its own.
std::string place_text(const NamedCause& cause);

/// "93 %, held out 91 %"; a dash where the nominal model leaves no more than noise.
std::string share_text(const FitAndCheck& share);
/// "0.05 mm, 0.2 N".
std::string change_text(const Change& change);

/// Values of a candidate's own parameters: "stiffness 0.81 N m/rad, ...".
std::string parameters_text(const Candidate& candidate);

/// Why a candidate lost against the best of the ranking, in words.
std::string why_it_lost(const Candidate& candidate, const Diagnosis& diagnosis);

/// The same of one that was not fitted to the end, and is not to be compared.
inline constexpr const char* left_early = "fell far behind on its way";

/// "Of youngs_modulus/density these data see the ratio alone, ..."; may be empty.
std::string ratios_text(const Verdict& verdict);

/// What is still unexplained, or what is known of something unknown, as sentences; may be empty.
std::string remainder_text(const Verdict& verdict);

/// How much of what the refitted model leaves the causes explain, as a sentence; empty unless
/// causes are named, or where it leaves noise alone.
std::string explained_text(const Verdict& verdict);

/// The gain on the held-out trials against the noise floor, one or two sentences.
std::string gain_text(const Diagnosis& diagnosis);

/// "extra_mass: mass from 0.004 kg on", for causes that are not named; those that nothing would
/// show are in the second list.
std::pair<std::vector<std::string>, std::vector<std::string>> detectable_limit_texts(
    const Verdict& verdict);

/// What has been decided, and on what: the sentence below the headline.
std::string certainty_text(const Diagnosis& diagnosis);

/// "turn about the root", the title of a symptom by its name.
std::string symptom_title(const std::string& name);

}  // namespace pedicel::discrepancy
