#pragma once

#include <string>
#include <vector>

#include "engine/core/random.h"
#include "tests/discrepancy/reference_trial.h"

namespace pedicel::hidden {

enum class PlantKind { stem, two_branches, side_branch, stiff_stem };
/// The last five are records as people make them: swings that have begun when the record begins;
/// probes that lead along one axis; a plate at the foot that feels force and moment; one camera and
/// a one-axis load cell; deflections at rest, without time.
enum class PackKind { release, weights, push, sweep, mix, moving, pusher, plate, planar, rest };
const char* name_of(PlantKind kind);
const char* name_of(PackKind kind);
bool as_people_make_them(PackKind kind);

/// Whether a pack's table has a column of a marker's axis (0 to 2), or of the force's.
bool measures_axis(PackKind kind, std::size_t marker, int axis);
bool measures_force_axis(PackKind kind, int axis);

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
