#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/select/candidates.h"
#include "plugins/discrepancy/select/needed_parameters.h"
#include "plugins/discrepancy/select/verdict.h"
#include "plugins/discrepancy/test/symptoms.h"

namespace pedicel::discrepancy {

inline constexpr double interval95 = 1.96;  ///< standard deviations

/// What a verdict is drawn from, and how its entries are made of it.
struct Findings {
  const DataSet* data = nullptr;
  const DiagnosisSettings* settings = &default_settings();
  std::vector<int> fit_trials;
  std::vector<Candidate> chain;  ///< causes found so far, in the order they were added
  HeldOut held_out;              ///< of all of them together, where they are several
  /// Of several causes, others that would stand in one's place beside the rest.
  struct Substitute {
    std::size_t link = 0;  ///< of the chain
    Candidate candidate;   ///< fitted with the rest, before which it stands or behind it
    double behind = 0.0;   ///< nats, of the evidence
  };
  std::vector<Substitute> substitutes;
  std::vector<Symptom> symptoms;    ///< of the refitted model
  Eigen::VectorXd parameter_shift;  ///< of the baseline's unknowns, by our own error
  double step = 0.0;                ///< s, of the fits
  /// Of modulus, density and damping, those that the data do not allow to be nominal.
  NeededParameters needed;

  int samples() const { return data->samples(fit_trials); }

  /// A free parameter with its 95 % interval, wider where more than noise is left and where our own
  /// error moves it. A moment is known to a step at best, however precise the data: when in a step
  /// a grip lets go, or a sample is taken, two honest solvers do differently.
  Estimate estimate(const FitSummary& fit, int parameter) const;
  /// By which errors of a fit are wider where more than noise is left.
  double spread(const FitSummary& fit) const;
  /// Mean square of what is left beyond the noise, in units of it.
  double excess(const FitSummary& model) const;
  /// A candidate as an entry of the verdict; its effect is `fit`'s number `effect`.
  NamedCause named(const Candidate& candidate, const FitSummary& fit, int effect,
                   const Errors& errors) const;

 private:
  std::string because(const std::string& cause, const Errors& errors) const;
};

/// The end of a curve that is clamped.
plant::CurvePlace root_place(const plant::PlantFile& plant);

}  // namespace pedicel::discrepancy
