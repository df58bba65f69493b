#pragma once

#include <cstddef>
#include <vector>

#include "plugins/discrepancy/select/candidates.h"

namespace pedicel::discrepancy {

/// What all data say for a candidate (nats), whatever its numbers cost.
double said_by_data(const Candidate& candidate);

/// Nats that another cause must bring beside those found: it must change the data by more than what
/// two honest solvers differ by, some units of the noise and a part of what the strongest one
/// changes (none, of what a sensor does). A gain is half the square of a change.
double least_gain_beside(const std::vector<Candidate>& found, const DiagnosisSettings& settings);

/// Nats that a competing model must lose by, or the data cannot tell it from `best`: clear odds,
/// and a part of what the best one gains, since our own errors grow with it.
double margin_over(const Candidate& best, const DiagnosisSettings& settings);

/// The least cost of the base and of the whole fits.
double least_cost(const std::vector<Candidate>& candidates, const FitSummary& base);

/// The mean square (noise units) that even the best of the whole fits leaves over so many samples,
/// at least 1: where it is more, differences count for less.
double dispersion_of(const std::vector<Candidate>& candidates, const FitSummary& base, int samples);

/// Sets the gains and the evidence of the whole fits and their limits, and sorts by evidence: the
/// whole fits first.
void weigh(std::vector<Candidate>& candidates, const FitSummary& base, int samples,
           double dispersion, const DiagnosisSettings& settings);

/// What a model's numbers cost (nats): how much narrower the data make them than what is known
/// beforehand, by Laplace's approximation (MacKay 2003, chapter 28). A number that the data leave
/// open is free, and so are the further sizes of its last effect that the data do not ask for: the
/// model without them is what they would be compared with (Dickey 1971, Annals of Mathematical
/// Statistics 42: the ratio of the densities at zero, afterwards and beforehand).
double cost_of_numbers(const FitSummary& model, double dispersion);

/// Bayesian information criterion: what a model's additional parameters cost, with the choice
/// between so many candidates (nats).
double cost_of(int parameters, int samples, std::size_t candidates);

}  // namespace pedicel::discrepancy
