#pragma once

#include <string>
#include <vector>

#include "discrepancy/reference_trial.h"
#include "pedicel/core/random.h"

namespace pedicel::hidden {

enum class PlantKind { stem, two_branches, side_branch, stiff_stem };
enum class PackKind { release, weights, push, sweep, mix };
const char* name_of(PlantKind kind);
const char* name_of(PackKind kind);

/// A plant with its markers and the place where it is held: about 25 elements of its own
/// `distance`.
struct Setting {
  PlantKind kind = PlantKind::stem;
  plant::PlantFile plant;
  std::vector<reference::MarkerPlan> markers;
  plant::CurvePlace hold;  ///< where it is pulled and pushed
  plant::CurvePlace tip;   ///< where weights hang
  double reach = 0.0;      ///< m, the length that amplitudes are shares of
};

/// Lengths, radii and moduli vary by some percent with the random numbers.
Setting make_setting(PlantKind kind, Random& random);

/// What is done in each of a pack's trials; all of it known. Holds start at `start` (m, W) of
/// Setting::hold, loads bend the plant by shares of `reach`, for which `softness` (m/N) is the
/// sideways compliance at the tip. The clock of trial i is i times `pause` (s).
std::vector<reference::TrialPlan> make_pack(PackKind kind, const Setting& setting,
                                            const Vec3& start, double softness, double pause,
                                            Random& random);

/// Sweeps of the foot that meet the first frequency of a single stem and none of the others, from
/// `softness`.
std::vector<reference::TrialPlan> first_mode_pack(const Setting& setting, double softness);

/// Sideways compliance of the tip, m/N, from two static equilibria of the reference.
double tip_softness(const Setting& setting);

}  // namespace pedicel::hidden
