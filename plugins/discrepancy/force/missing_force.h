#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/force/force_library.h"

namespace pedicel::discrepancy {

/// What is known of a force that no named cause stands for.
struct MissingForce {
  /// Beyond what noise gives. False: the rest says nothing.
  bool found = false;
  /// Where it acts; nothing where it is the instrument's, or where no place fits.
  std::optional<plant::CurvePlace> place;
  double place_error = 0.0;  ///< 1, standard deviation of place->at; 0: not known
  /// On other curves, where a law explains the data as well.
  std::vector<plant::CurvePlace> elsewhere;
  /// "string", "stop", "attraction to a point", "periodic push", "constant push", "drag at a
  /// point", "friction at a point", "jolt", "push that begins during a trial"; "sensor" where
  /// markers seem to move that the plant does not; "force of no known law".
  std::string kind;
  /// Other kinds that explain the data as well: within odds of 20 to 1, or as what `kind` is where
  /// its other end is far away (a stop: a string; a constant push: an attraction).
  std::vector<std::string> other_kinds;
  std::string where, when, how, what;  ///< sentences
  double evidence = 0.0;               ///< nats above the model, less what its numbers cost
  double share = 0.0;            ///< of what the model left above the noise on the fitted trials
  std::optional<double> gain;    ///< the same of the RMS error on the held-out trials
  std::vector<ForceTerm> terms;  ///< the laws that were refitted, best first
  FitSummary fit;                ///< the model with the force, refitted; "not run" without a law
  long simulations = 0;

  /// What makes the held-out trials worse is not found: this says so.
  std::string refused;

  /// All of it in words, "Do not extrapolate." at the end; empty where nothing was found.
  std::string sentence() const;
};

struct MissingForceOptions {
  FitOptions fit;          ///< its trials are those that `model` was fitted to
  std::vector<int> check;  ///< held-out trials
  int threads = 1;
  /// m between nodes where linear responses are simulated, which are many and are differences; 0:
  /// as in the evaluator.
  double response_distance = 0.0;
  /// nats: where no free force, with any history, has more evidence than this, no law is tried.
  double least_evidence = 0.0;
  /// Corrects the evaluator about a model that is far from where it was corrected before.
  std::function<void(const FitSummary&)> correct_at;
  std::function<void(const std::string&)> note;  ///< each finding, as a sentence
};

/// Infers the force that a fitted model lacks. Every marker is a place it may act at: the histories
/// of such a force are estimated from the linear response of the model (ForceSpace), and along the
/// measured motion there every law of the library is tried. The best laws are put into the
/// model and refitted with it, their place along the curve included; what the refits gain decides.
/// Simulates about 100 variants a marker and trial.
MissingForce infer_missing_force(Evaluator& evaluator, const FitSummary& model,
                                 const MissingForceOptions& options);

}  // namespace pedicel::discrepancy
