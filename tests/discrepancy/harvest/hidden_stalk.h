#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/discrepancy/scene_cases/scene_case.h"

/// Stalks that only the robot feels: joints and a wrist's wrench, and no marker. Each has a length,
/// radius, modulus and place of its own, stands elsewhere than its scene says, in a direction that
/// the seed draws, and is stiffer or softer.
namespace pedicel::harvest {

/// A number that was told beside the true one.
struct Told {
  double off = 0.0;        ///< told less true, in the unit of its column
  bool is_inside = false;  ///< the truth is in the 95 % interval
};

/// What a diagnosis says of one hidden stalk.
struct StalkTold {
  scene_case::Setting pushed, pulled;  ///< what was made
  std::string outcome;
  std::vector<Told> hold;          ///< m, along the stem: by push
  std::optional<Told> attachment;  ///< m, distance; inside where each of three axes is
  std::optional<Told> bearing;     ///< rad, of the way from where the tool holds to the attachment
  std::optional<Told> direction;   ///< rad, of the way from the files' place to the told one
  std::optional<Told> modulus;     ///< 1, relative
  std::vector<Told> moment;        ///< s, when the force breaks off: by pull
  std::string findings;
};

/// Pushes with the attachment displaced and another modulus.
scene_case::Setting pushed_stalk(std::uint64_t seed);
/// Pulls at a fruit, whose stalk breaks at another force than its file says.
scene_case::Setting pulled_stalk(std::uint64_t seed);

/// Makes both in `folder`, diagnoses the pushes, and looks at the wrench of the pulls. Throws
/// InvalidFile, and std::runtime_error where MuJoCo fails.
StalkTold look_at_stalk(const std::filesystem::path& folder, std::uint64_t seed, int threads);

/// One line a stalk, and how many are within the aims, in Markdown.
std::string table(const std::vector<StalkTold>& stalks);

/// Aims: m, rad, 1, s.
inline constexpr double hold_aim = 0.01, direction_aim = 5.0 / 57.29577951308232,
                        modulus_aim = 0.05, moment_aim = 0.03;

}  // namespace pedicel::harvest
