#include "app/steer/state_fields.h"

#include <array>

namespace pedicel::app {

namespace {

// "x y z w" of a quaternion, as in files.
constexpr std::array<StateField, static_cast<std::size_t>(Field::count)> field_table{{
    {"positions", Rows::segment, 3, "m", false, "where each segment's far node is, in the world"},
    {"orientations", Rows::segment, 4, "1", false,
     "quaternions x y z w that turn each segment's frame into the world's; its third axis points "
     "along the segment"},
    {"velocities", Rows::segment, 3, "m/s", false,
     "of each segment's centre of mass, in the world"},
    {"angular_velocities", Rows::segment, 3, "rad/s", false, "of each segment, in its own frame"},
    {"strains", Rows::segment, 6, "1 and rad", false,
     "from the unloaded shape, in each segment's frame: shear along axes 1 and 2, stretch (1), "
     "then "
     "the joint's bend about axes 1 and 2, and twist (rad)"},
    {"segment_loads", Rows::segment, 6, "N and N m", false,
     "elastic force (N) and moment (N m) of each segment and its joint, in its frame"},
    {"attached", Rows::segment, 1, "1", true, "false once a segment came off with its fruit"},
    {"fruit_positions", Rows::fruit, 3, "m", false,
     "each fruit's centre in the world, on the plant or off it"},
    {"fruit_velocities", Rows::fruit, 3, "m/s", false, "of each fruit's centre, in the world"},
    {"fruit_attached", Rows::fruit, 1, "1", true, "false once a fruit came off"},
    {"fruit_forces", Rows::fruit, 1, "N", false,
     "sum of the normal forces of what touches each fruit on its plant"},
    {"stalk_loads", Rows::fruit, 6, "N and N m", false,
     "force (N) and moment (N m) in the joint that carries each fruit, in its segment's frame; "
     "zero "
     "once it is off"},
    {"stalk_margins", Rows::fruit, 1, "1", false,
     "how near each fruit is to coming off: the largest ratio of a strain or load to its "
     "threshold; "
     "at 1 it breaks, and it is 1 from then on"},
    {"organ_forces", Rows::organ, 3, "N", false,
     "force of what touches each organ on it, in the world"},
    {"organ_contact_forces", Rows::organ, 1, "N", false, "sum of the normal forces at each organ"},
    {"link_forces", Rows::touching, 3, "N", false,
     "force of the plants on each link, body and the ground, in the world"},
    {"link_contact_forces", Rows::touching, 1, "N", false,
     "sum of the normal forces of the plants at each link, body and the ground"},
    {"joint_positions", Rows::joint, 1, "rad or m", false, "of the robot"},
    {"joint_velocities", Rows::joint, 1, "rad/s or m/s", false, "of the robot"},
    {"joint_torques", Rows::joint, 1, "N m or N", false,
     "what each motor applied in the last step"},
    {"link_poses", Rows::link, 7, "m and 1", false,
     "position (m) and quaternion x y z w of each link's frame in the world"},
    {"tool_pose", Rows::one, 7, "m and 1", false,
     "position (m) and quaternion x y z w of the tool in the world; nan without a robot"},
    {"body_poses", Rows::body, 7, "m and 1", false,
     "position (m) and quaternion x y z w of each body of the scene"},
    {"energies", Rows::one, 3, "J", false, "of all plants: kinetic, elastic, of gravity"},
}};

}  // namespace

std::string_view name_of(Rows rows) {
  constexpr std::string_view names[row_kinds] = {"one",    "segments", "fruits", "organs",
                                                 "joints", "links",    "bodies", "touching"};
  return names[static_cast<int>(rows)];
}

std::span<const StateField> state_fields() {
  return field_table;
}

}  // namespace pedicel::app
