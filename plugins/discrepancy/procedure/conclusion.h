#pragma once

#include "plugins/discrepancy/procedure/diagnosis.h"
#include "plugins/discrepancy/select/findings.h"

namespace pedicel::discrepancy {

/// The verdict's parts, in the order in which they are drawn. All read the fits, alarms and ranking
/// of the diagnosis and fill in its verdict.

/// RMS residuals of the three models and the gain, from the diagnosis's predictions.
void measure_errors(const Findings& findings, Diagnosis& diagnosis);

/// Outcome, causes, competing models and remainder.
void conclude(const Findings& findings, Diagnosis& diagnosis);

/// Whether modulus, density and damping of a model are all within what is known of them, three
/// deviations included: then none of them can be a cause.
bool knows_parameters(const Findings& findings, const FitSummary& model);

/// Of the parameters that are needed beside the causes of `best`, those that leave what is known of
/// them (`known_to`), with the numbers of the model that has the others at their nominal values.
std::vector<NamedCause> parameters_off(const Findings& findings, const NeededParameters& needed,
                                       const FitSummary& best);

/// Where the outcome is `unknown`: what was fitted but does not explain the data stands under
/// `nearest`, not among the causes, and it gains nothing.
void name_nothing(Verdict& verdict);

/// Outliers were left out before the fit; they are named beside what else was found.
void conclude_outliers(Diagnosis& diagnosis);

/// A law of detachment in place of the file's thresholds, where the diagnosis's `strength` needs
/// one: a cause beside what else was found, and an effect of the best model.
void conclude_detachment(Diagnosis& diagnosis);

/// Modulus, density and damping of the best model, in their own units.
void report_parameters(const Findings& findings, Diagnosis& diagnosis);

/// The size from which each cause would have been seen, from the diagnosis's directions.
void report_detectable_limits(const std::vector<Cause>& causes, Diagnosis& diagnosis);

}  // namespace pedicel::discrepancy
