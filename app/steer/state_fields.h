#pragma once

#include <span>
#include <string_view>

namespace pedicel::app {

/// What the rows of a field count, in the order of StateLayout's names.
enum class Rows { one, segment, fruit, organ, joint, link, body, touching };
inline constexpr int row_kinds = 8;
/// "segments", for people.
std::string_view name_of(Rows rows);

/// An array of a simulation's state: its one description, for the module, its stubs and the manual.
struct StateField {
  std::string_view name;
  Rows rows = Rows::one;
  int columns = 1;        ///< 1: an array with one axis (a scalar has Rows::one)
  std::string_view unit;  ///< one of known_units(), or several, for people
  bool flag = false;      ///< true or false, not a number
  std::string_view sentence;
};

/// All of them. Their order is that of the enumerators of Field.
std::span<const StateField> state_fields();

enum class Field {
  positions,
  orientations,
  velocities,
  angular_velocities,
  strains,
  segment_loads,
  attached,
  fruit_positions,
  fruit_velocities,
  fruit_attached,
  fruit_forces,
  stalk_loads,
  stalk_margins,
  organ_forces,
  organ_contact_forces,
  link_forces,
  link_contact_forces,
  joint_positions,
  joint_velocities,
  joint_torques,
  link_poses,
  tool_pose,
  body_poses,
  energies,
  count,
};

}  // namespace pedicel::app
