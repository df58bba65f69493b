#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/discrepancy/distinguishability.h"
#include "tests/discrepancy/hidden_effect.h"

namespace pedicel::hidden {

/// The verdict that a diagnosis should give.
enum class Expected { adequate, named, ambiguous, unknown };
const char* name_of(Expected expected);

/// What is asked of one case; the details are drawn from the seed.
struct CaseOrder {
  enum class Kind { null, effect, pair, look_alike, outside };
  int number = 0;
  Kind kind = Kind::null;
  PlantKind plant = PlantKind::stem;
  PackKind pack = PackKind::mix;
  std::vector<std::string> hidden;  ///< names; of a look-alike all that fit, the true one first
  double size = 0.0;                ///< times the smallest identifiable
  bool told_apart = false;          ///< which tells one effect from every other; false: it is seen
  bool coloured = false;            ///< noise AR(1) with rho 0.5 to 0.95, else white
  bool off = false;                 ///< nominal modulus and damping are off, too
  bool hidden_start = false;        ///< holds start where the hidden plant settles, not the nominal
};
const char* name_of(CaseOrder::Kind kind);

/// The cases of the bench: 120 null, 232 with one effect, 32 with two, 32 look-alikes and 32 from
/// outside the list. The kinds are spread, so that any stretch of numbers holds all of them. Behind
/// them stand those of later_uses() and record_uses().
const std::vector<CaseOrder>& case_orders();

/// A finished case: what was hidden, what a diagnosis should say, and where its data lie.
struct HiddenCase {
  CaseOrder order;
  std::uint64_t seed = 0;
  std::string name;
  std::vector<plant::Effect> causes;              ///< what is to be named, with the true parameters
  std::vector<reference::OutsideEffect> outside;  ///< what is outside the list
  std::vector<plant::Effect> refitted;  ///< true factors on the nominal modulus and damping
  Expected expected = Expected::adequate;
  std::vector<std::string> look_alikes;  ///< every name that an ambiguous verdict may list
  double sine = 1.0;                     ///< of the angle between look-alikes
  std::vector<double> smallest;  ///< identifiable size of each cause or effect outside the list
  std::vector<double> size;      ///< of each; in effects_size's own units
  std::vector<double> visible;   ///< noise units beyond a refit, of each on its own
  Distinguishability::Nearest nearest;  ///< of one effect that is told apart: what comes nearest
  Noise noise;
  Setting setting;  ///< the nominal plant and its markers
  std::vector<reference::TrialPlan> trials;
  std::vector<reference::Record> records;  ///< with noise
  std::vector<reference::Record> clean;    ///< the same without it: what the true model predicts
  std::filesystem::path folder;            ///< once it is written
};

/// Where what is to be hidden leaves no trace in the data, or none of its own, however it is drawn.
struct NoTrace : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Simulates a case. The same seed and order give the same bits. Throws NoTrace.
HiddenCase make_case(std::uint64_t seed, const CaseOrder& order);

/// Writes `folder`/NAME, an experiment that gives nothing away, and `folder`/NAME.truth.json.
/// Throws io::WriteError.
void write_case(const std::filesystem::path& folder, HiddenCase& hidden);

/// The truth as JSON.
std::string truth_text(const HiddenCase& hidden);

}  // namespace pedicel::hidden
