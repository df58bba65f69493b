#include "plugins/simulation/quantities.h"

#include <algorithm>
#include <limits>

#include "plugins/simulation/place.h"
#include "plugins/simulation/simulation.h"

namespace pedicel::simulation {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const cosserat::RodModel& model_of(const Row& row) {
  return row.simulation.rods().model(row.plant);
}

const cosserat::RodState& state_of(const Row& row) {
  return row.simulation.rods().state(row.plant);
}

const cosserat::Fruit& fruit_of(const Row& row) {
  return model_of(row).fruits[row.index];
}

bool is_gone(const Row& row) {
  return state_of(row).fruit_gone[row.index] != 0;
}

const coupling::ContactSum& fruit_touch(const Row& row) {
  return row.simulation.plant_step().contacts().fruits(row.plant)[row.index];
}

const coupling::ContactSum& organ_touch(const Row& row) {
  return row.simulation.plant_step().contacts().organs(row.plant)[row.index];
}

/// Of a link or a body, over its colliders. What was added since the start are fruits that fell.
template <class Value>
Value touching(const Row& row, Value coupling::ContactSum::*value, Value sum) {
  const auto& sums = row.simulation.plant_step().contacts().colliders();
  const std::size_t known = std::min(sums.size(), row.layout.touching_of.size());
  for (std::size_t c = 0; c < known; ++c)
    if (row.layout.touching_of[c] == row.index) sum += sums[c].*value;
  return sum;
}

void write(double* to, const Vec3& v) {
  std::copy_n(v.data(), 3, to);
}

void write(double* to, const Quat& q) {
  std::copy_n(q.coeffs().data(), 4, to);  // x, y, z, w
}

void write(double* to, const Pose& pose) {
  write(to, pose.position);
  write(to + 3, pose.rotation);
}

void write_load(double* to, const Row& row, int element) {
  const cosserat::JointLoad load = cosserat::joint_load(model_of(row), state_of(row), element);
  write(to, load.force);
  write(to + 3, load.moment);
}

void read_strain(const Row& row, double* to) {
  if (!state_of(row).alive[row.index]) return void(std::fill_n(to, 6, 0.0));
  const cosserat::Strain strain = cosserat::strain_of(model_of(row), state_of(row), row.index);
  write(to, strain.stretch);
  write(to + 3, strain.bend);
}

void read_segment_load(const Row& row, double* to) {
  if (!state_of(row).alive[row.index]) return void(std::fill_n(to, 6, 0.0));
  write_load(to, row, row.index);
}

void read_fruit_position(const Row& row, double* to) {
  const auto fallen = fallen_fruit(row.simulation, row.plant, row.index);
  write(to, fallen ? fallen->centre
                   : cosserat::point_on(model_of(row), state_of(row), fruit_of(row).element,
                                        fruit_of(row).back));
}

void read_fruit_velocity(const Row& row, double* to) {
  const auto fallen = fallen_fruit(row.simulation, row.plant, row.index);
  write(to, fallen ? fallen->velocity
                   : cosserat::velocity_on(model_of(row), state_of(row), fruit_of(row).element,
                                           fruit_of(row).back));
}

void read_stalk_load(const Row& row, double* to) {
  if (is_gone(row)) return void(std::fill_n(to, 6, 0.0));
  write_load(to, row, fruit_of(row).element);
}

void read_stalk_strain(const Row& row, double* to) {
  if (is_gone(row)) return void(std::fill_n(to, 2, none));
  const cosserat::Strain strain =
      cosserat::strain_of(model_of(row), state_of(row), fruit_of(row).element);
  to[0] = strain.stretch.norm();
  to[1] = strain.bend.norm();
}

void read_stalk_size(const Row& row, double* to) {
  if (is_gone(row)) return void(std::fill_n(to, 2, none));
  const cosserat::JointLoad load =
      cosserat::joint_load(model_of(row), state_of(row), fruit_of(row).element);
  to[0] = load.force.norm();
  to[1] = load.moment.norm();
}

void read_margin(const Row& row, double* to) {
  *to = cosserat::margin_used(model_of(row), state_of(row), row.index);
}

void read_tool(const Row& row, double* to) {
  const RobotControl* robot = row.simulation.robot();
  if (!robot) return void(std::fill_n(to, 7, none));
  write(to, robot->tool_pose());
}

void read_energies(const Row& row, double* to) {
  std::fill_n(to, 3, 0.0);
  for (int p = 0; p < row.simulation.rods().size(); ++p) {
    const cosserat::Energy own =
        cosserat::energy_of(row.simulation.rods().model(p), row.simulation.rods().state(p),
                            row.simulation.scene().gravity);
    to[0] += own.kinetic;
    to[1] += own.elastic;
    to[2] += own.gravity;
  }
}

void read_largest_stretch(const Row& row, double* to) {
  const cosserat::RodSystem& rods = row.simulation.rods();
  *to = 0.0;
  for (int p = 0; p < rods.size(); ++p)
    for (int e = 0; e < rods.model(p).size(); ++e)
      if (rods.state(p).alive[e])
        *to = std::max(*to, cosserat::strain_of(rods.model(p), rods.state(p), e).stretch.norm());
}

// In the order of the columns of log.csv, as far as these are of the same rows.
const std::vector<Quantity>& table() {
  static const std::vector<Quantity> all = {
      {"positions", Rows::segment, 3, "m", false, "where each segment's far node is, in the world",
       [](const Row& row, double* to) { write(to, state_of(row).position[row.index]); }},
      {"orientations", Rows::segment, 4, "1", false,
       "quaternions x y z w that turn each segment's frame into the world's; its third axis points "
       "along the segment",
       [](const Row& row, double* to) { write(to, state_of(row).orientation[row.index]); }},
      {"velocities", Rows::segment, 3, "m/s", false,
       "of each segment's centre of mass, in the world",
       [](const Row& row, double* to) { write(to, state_of(row).velocity[row.index]); }},
      {"angular_velocities", Rows::segment, 3, "rad/s", false, "of each segment, in its own frame",
       [](const Row& row, double* to) { write(to, state_of(row).angular_velocity[row.index]); }},
      {"strains", Rows::segment, 6, "1 and rad", false,
       "from the unloaded shape, in each segment's frame: shear along axes 1 and 2, stretch (1), "
       "then the joint's bend about axes 1 and 2, and twist (rad)",
       read_strain},
      {"segment_loads", Rows::segment, 6, "N and N m", false,
       "elastic force (N) and moment (N m) of each segment and its joint, in its frame",
       read_segment_load},
      {"attached", Rows::segment, 1, "1", true, "false once a segment came off with its fruit",
       [](const Row& row, double* to) { *to = state_of(row).alive[row.index] != 0; }},
      {"",
       Rows::fruit,
       3,
       "N",
       false,
       "force of what touches each fruit on it, in the world",
       [](const Row& row, double* to) { write(to, fruit_touch(row).force_W); },
       {},
       false,
       "force.x force.y force.z"},
      {"", Rows::fruit, 2, "1 and rad", false, "strain of its stalk: stretch and bend",
       read_stalk_strain, "*_stretch_1 *_bend_rad"},
      {"", Rows::fruit, 1, "1", false, "share of a threshold that is used", read_margin,
       "*_margin_used_1", false, "margin_used"},
      {"", Rows::fruit, 2, "N and N m", false, "force and moment in its stalk", read_stalk_size,
       "*_stalk_N *_stalk_Nm"},
      {"fruit_forces", Rows::fruit, 1, "N", false,
       "sum of the normal forces of what touches each fruit on its plant",
       [](const Row& row, double* to) { *to = fruit_touch(row).normal; }, "*_contact_N", false,
       "normal"},
      {"",
       Rows::fruit,
       1,
       "N",
       false,
       "friction at each fruit on its plant",
       [](const Row& row, double* to) { *to = fruit_touch(row).tangential; },
       {},
       false,
       "tangential"},
      {"fruit_positions", Rows::fruit, 3, "m", false,
       "each fruit's centre in the world, on the plant or off it", read_fruit_position,
       "- - *_z_m"},
      {"fruit_velocities", Rows::fruit, 3, "m/s", false, "of each fruit's centre, in the world",
       read_fruit_velocity},
      {"fruit_attached", Rows::fruit, 1, "1", true, "false once a fruit came off",
       [](const Row& row, double* to) { *to = !is_gone(row); }},
      {"stalk_loads", Rows::fruit, 6, "N and N m", false,
       "force (N) and moment (N m) in the joint that carries each fruit, in its segment's frame; "
       "zero once it is off",
       read_stalk_load},
      {"stalk_margins", Rows::fruit, 1, "1", false,
       "how near each fruit is to coming off: the largest ratio of a strain or load to its "
       "threshold; at 1 it breaks, and it is 1 from then on",
       [](const Row& row, double* to) {
         read_margin(row, to);
         if (is_gone(row)) *to = 1.0;
       }},
      {"organ_forces",
       Rows::organ,
       3,
       "N",
       false,
       "force of what touches each organ on it, in the world",
       [](const Row& row, double* to) { write(to, organ_touch(row).force_W); },
       {},
       false,
       "force.x force.y force.z"},
      {"organ_contact_forces", Rows::organ, 1, "N", false, "sum of the normal forces at each organ",
       [](const Row& row, double* to) { *to = organ_touch(row).normal; }, "contact_*_normal_N",
       false, "normal"},
      {"", Rows::organ, 1, "N", false, "friction at each organ",
       [](const Row& row, double* to) { *to = organ_touch(row).tangential; },
       "contact_*_tangential_N", false, "tangential"},
      {"link_forces", Rows::touching, 3, "N", false,
       "force of the plants on each link, body and the ground, in the world",
       [](const Row& row, double* to) {
         write(to, touching<Vec3>(row, &coupling::ContactSum::force_W, Vec3::Zero()));
       }},
      {"link_contact_forces", Rows::touching, 1, "N", false,
       "sum of the normal forces of the plants at each link, body and the ground",
       [](const Row& row, double* to) { *to = touching(row, &coupling::ContactSum::normal, 0.0); },
       "contact_*_normal_N"},
      {"", Rows::touching, 1, "N", false, "friction of the plants there",
       [](const Row& row, double* to) {
         *to = touching(row, &coupling::ContactSum::tangential, 0.0);
       },
       "contact_*_tangential_N"},
      {"", Rows::joint, 1, "rad or m", false, "what each encoder reads",
       [](const Row& row, double* to) { *to = row.simulation.robot()->reading(row.index); },
       "joint_*_rad joint_*_m"},
      {"joint_positions",
       Rows::joint,
       1,
       "rad or m",
       false,
       "of the robot",
       [](const Row& row, double* to) {
         *to = row.simulation.robot()->robot().positions()[row.index];
       },
       {},
       false,
       "position"},
      {"joint_velocities",
       Rows::joint,
       1,
       "rad/s or m/s",
       false,
       "of the robot",
       [](const Row& row, double* to) {
         *to = row.simulation.robot()->robot().velocities()[row.index];
       },
       {},
       false,
       "velocity"},
      {"joint_torques", Rows::joint, 1, "N m or N", false,
       "what each motor applied in the last step",
       [](const Row& row, double* to) {
         *to = row.simulation.robot()->robot().motor_torques()[row.index];
       },
       "torque_*_Nm torque_*_N", false, "effort"},
      {"link_poses", Rows::link, 7, "m and 1", false,
       "position (m) and quaternion x y z w of each link's frame in the world",
       [](const Row& row, double* to) { write(to, row.simulation.robot()->link_pose(row.index)); }},
      {"tool_pose", Rows::one, 7, "m and 1", false,
       "position (m) and quaternion x y z w of the tool in the world; nan without a robot",
       read_tool, "tool_x_m tool_y_m tool_z_m", true},
      {"body_poses", Rows::body, 7, "m and 1", false,
       "position (m) and quaternion x y z w of each body of the scene",
       [](const Row& row, double* to) { write(to, row.simulation.world().body_pose(row.index)); }},
      {"energies", Rows::one, 3, "J", false, "of all plants: kinetic, elastic, of gravity",
       read_energies, "energy_kinetic_J energy_elastic_J energy_gravity_J"},
      {"", Rows::one, 1, "1", false, "largest stretch of any segment", read_largest_stretch,
       "stretch_max_1"},
      {"", Rows::one, 1, "1", false, "contacts of plants",
       [](const Row& row, double* to) { *to = row.simulation.world().report().contacts; },
       "contacts_1"},
      {"", Rows::one, 1, "1", false, "fruits that came off so far",
       [](const Row& row, double* to) {
         *to = static_cast<double>(row.simulation.plant_step().detached().size());
       },
       "detached_1"},
  };
  return all;
}

std::vector<std::string>& names_of(RowLayout& layout, Rows kind) {
  return layout.names[static_cast<int>(kind)];
}

void add_plant(RowLayout& layout, const cosserat::RodModel& model) {
  const int segments = layout.rows(Rows::segment), organs = layout.rows(Rows::organ);
  layout.first_segment.push_back(segments);
  layout.first_organ.push_back(organs);
  layout.first_fruit.push_back(layout.rows(Rows::fruit));
  for (const cosserat::Element& element : model.elements) {
    layout.segment_organ.push_back(organs + element.organ);
    layout.segment_parent.push_back(element.parent < 0 ? -1 : segments + element.parent);
    names_of(layout, Rows::segment).push_back(model.organs[element.organ]);
  }
  for (const std::string& organ : model.organs) names_of(layout, Rows::organ).push_back(organ);
  for (std::size_t f = 0; f < model.fruits.size(); ++f)
    names_of(layout, Rows::fruit).push_back(fruit_name(model, static_cast<int>(f)));
}

// Colliders of one link or body are one row. Fruits that fall become colliders later on.
void add_touching(RowLayout& layout, const coupling::ColliderSet& colliders) {
  std::vector<std::string>& names = names_of(layout, Rows::touching);
  for (int c = 0; c < colliders.size(); ++c) {
    const std::string& name = colliders.collider(c).name;
    const auto found = std::ranges::find(names, name);
    layout.touching_of.push_back(static_cast<int>(found - names.begin()));
    if (found == names.end()) names.push_back(name);
  }
}

}  // namespace

std::string_view name_of(Rows rows) {
  constexpr std::string_view names[row_kinds] = {"one",    "segments", "fruits", "organs",
                                                 "joints", "links",    "bodies", "touching"};
  return names[static_cast<int>(rows)];
}

RowLayout::RowLayout(const Simulation& simulation) {
  names_of(*this, Rows::one).emplace_back();
  for (int p = 0; p < simulation.rods().size(); ++p) add_plant(*this, simulation.rods().model(p));
  first_segment.push_back(rows(Rows::segment));
  first_fruit.push_back(rows(Rows::fruit));
  first_organ.push_back(rows(Rows::organ));
  if (const RobotControl* robot = simulation.robot()) {
    names_of(*this, Rows::joint) = robot->robot().model().joint_names();
    for (const robot::Link& link : robot->description().links)
      names_of(*this, Rows::link).push_back(link.name);
  }
  for (const world::BodyDescription& body : simulation.scene().bodies)
    names_of(*this, Rows::body).push_back(body.name);
  add_touching(*this, simulation.colliders());
}

std::span<const Quantity> quantities() {
  return table();
}

}  // namespace pedicel::simulation
