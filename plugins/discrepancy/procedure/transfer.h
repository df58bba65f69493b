#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/discrepancy/fit/parameter_fit.h"
#include "plugins/discrepancy/select/verdict.h"

namespace pedicel::discrepancy {

struct TransferOptions {
  int threads = 1;
  std::function<void(const std::string&, double)> progress;  ///< from any thread
  const std::atomic<bool>* stop = nullptr;
  bool stopped() const { return stop && *stop; }
};

/// What effects that were found in one experiment do for another one.
struct Transfer {
  std::string refusal;               ///< why these data cannot be used; empty: they can
  std::vector<std::string> effects;  ///< names of those that were carried over
  /// `extended` is the model with the effects, their numbers as they came.
  Errors fit, check;
  std::optional<double> gain;  ///< over the refitted model, on the trials held out
  /// Factors on modulus, density and damping: without the effects and with them.
  std::vector<std::pair<std::string, double>> refitted, extended;
  long simulations = 0;
  bool stopped = false;

  /// Whether the effects carry over, in a sentence.
  std::string sentence() const;
};

/// Of what makes the first plant another one than its file says, nothing belongs to the second: the
/// effects without the factors on the material.
std::vector<plant::Effect> carried_effects(const std::vector<plant::Effect>& effects);

/// Carries effects over to another experiment. Modulus, density and damping are fitted to its
/// trials without the effects and with them; the effects' own numbers stay. Throws UsageError where
/// an effect sits on a curve that no plant of it has.
Transfer transfer(FitGround& ground, const std::vector<plant::Effect>& carried,
                  const TransferOptions& options);
/// The same of a single plant, with the effects of `extended`.
Transfer transfer(const plant::PlantFile& extended, const Experiment& experiment,
                  const TransferOptions& options);

std::string to_json(const Transfer& transfer);

}  // namespace pedicel::discrepancy
