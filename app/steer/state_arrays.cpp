#include "app/steer/state_arrays.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "plugins/simulation/place.h"
#include "plugins/simulation/plants/plant_step.h"

namespace pedicel::app {

namespace {

void write(double* to, const Vec3& v) {
  for (int i = 0; i < 3; ++i) to[i] = v[i];
}

void write(double* to, const Quat& q) {
  // Eigen keeps x, y, z, w.
  for (int i = 0; i < 4; ++i) to[i] = q.coeffs()[i];
}

void write(double* to, const Pose& pose) {
  write(to, pose.position);
  write(to + 3, pose.rotation);
}

void write(double* to, const Vec3& first, const Vec3& second) {
  write(to, first);
  write(to + 3, second);
}

void write_load(double* to, const cosserat::RodModel& model, const cosserat::RodState& state,
                int element) {
  const cosserat::JointLoad load = cosserat::joint_load(model, state, element);
  write(to, load.force, load.moment);
}

}  // namespace

StateArrays::StateArrays(StateLayout layout, int worlds)
    : layout_(std::move(layout)), worlds_(worlds) {
  for (std::size_t f = 0; f < fields; ++f) {
    const StateField& field = state_fields()[f];
    const auto size = static_cast<std::size_t>(worlds) *
                      static_cast<std::size_t>(layout_.rows(field.rows)) *
                      static_cast<std::size_t>(field.columns);
    // Never empty, so that a view has a place.
    if (field.flag)
      flags_[f].resize(std::max<std::size_t>(size, 1));
    else
      numbers_[f].resize(std::max<std::size_t>(size, 1));
  }
}

bool StateArrays::want(Field field) {
  return !std::exchange(wanted_[static_cast<std::size_t>(field)], true);
}

double* StateArrays::row(Field field, int world, int row) {
  const StateField& one = state_fields()[static_cast<std::size_t>(field)];
  return numbers(field) +
         (static_cast<std::ptrdiff_t>(world) * layout_.rows(one.rows) + row) * one.columns;
}

template <class Write>
void StateArrays::each(Field field, int world, int first, int count, const Write& write_row) {
  if (!wanted_[static_cast<std::size_t>(field)] || count == 0) return;
  const int columns = state_fields()[static_cast<std::size_t>(field)].columns;
  double* to = row(field, world, first);
  for (int i = 0; i < count; ++i, to += columns) write_row(to, i);
}

template <class Read>
void StateArrays::each_flag(Field field, int world, int first, int count, const Read& read) {
  if (!wanted_[static_cast<std::size_t>(field)]) return;
  const StateField& one = state_fields()[static_cast<std::size_t>(field)];
  std::uint8_t* to =
      flags(field) + static_cast<std::ptrdiff_t>(world) * layout_.rows(one.rows) + first;
  for (int i = 0; i < count; ++i) to[i] = read(i);
}

void StateArrays::fill(const simulation::Simulation& simulation, int world) {
  for (int p = 0; p < simulation.rods().size(); ++p) {
    fill_segments(simulation, world, p);
    fill_fruits(simulation, world, p);
    fill_moving_fruits(simulation, world, p);
    fill_organs(simulation, world, p);
  }
  if (simulation.robot())
    fill_robot(*simulation.robot(), world);
  else
    each(Field::tool_pose, world, 0, 1,
         [](double* to, int) { std::fill_n(to, 7, std::numeric_limits<double>::quiet_NaN()); });
  fill_touching(simulation, world);
  each(Field::body_poses, world, 0, layout_.rows(Rows::body),
       [&](double* to, int b) { write(to, simulation.world().body_pose(b)); });
  fill_energies(simulation, world);
}

void StateArrays::fill_segments(const simulation::Simulation& simulation, int world, int plant) {
  const cosserat::RodModel& model = simulation.rods().model(plant);
  const cosserat::RodState& state = simulation.rods().state(plant);
  const int first = layout_.first_segment[plant], count = model.size();
  each(Field::positions, world, first, count,
       [&](double* to, int e) { write(to, state.position[e]); });
  each(Field::orientations, world, first, count,
       [&](double* to, int e) { write(to, state.orientation[e]); });
  each(Field::velocities, world, first, count,
       [&](double* to, int e) { write(to, state.velocity[e]); });
  each(Field::angular_velocities, world, first, count,
       [&](double* to, int e) { write(to, state.angular_velocity[e]); });
  each(Field::strains, world, first, count, [&](double* to, int e) {
    if (!state.alive[e]) return void(std::fill_n(to, 6, 0.0));
    const cosserat::Strain strain = cosserat::strain_of(model, state, e);
    write(to, strain.stretch, strain.bend);
  });
  each(Field::segment_loads, world, first, count, [&](double* to, int e) {
    if (!state.alive[e]) return void(std::fill_n(to, 6, 0.0));
    write_load(to, model, state, e);
  });
  each_flag(Field::attached, world, first, count, [&](int e) { return state.alive[e] != 0; });
}

void StateArrays::fill_fruits(const simulation::Simulation& simulation, int world, int plant) {
  const cosserat::RodModel& model = simulation.rods().model(plant);
  const cosserat::RodState& state = simulation.rods().state(plant);
  const int first = layout_.first_fruit[plant], count = static_cast<int>(model.fruits.size());
  each_flag(Field::fruit_attached, world, first, count,
            [&](int f) { return !state.fruit_gone[f]; });
  each(Field::fruit_forces, world, first, count, [&](double* to, int f) {
    *to = simulation.plant_step().contacts().fruits(plant)[f].normal;
  });
  each(Field::stalk_margins, world, first, count, [&](double* to, int f) {
    *to = state.fruit_gone[f] ? 1.0 : cosserat::margin_used(model, state, f);
  });
  each(Field::stalk_loads, world, first, count, [&](double* to, int f) {
    if (state.fruit_gone[f]) return void(std::fill_n(to, 6, 0.0));
    write_load(to, model, state, model.fruits[f].element);
  });
}

void StateArrays::fill_moving_fruits(const simulation::Simulation& simulation, int world,
                                     int plant) {
  const cosserat::RodModel& model = simulation.rods().model(plant);
  const cosserat::RodState& state = simulation.rods().state(plant);
  const int first = layout_.first_fruit[plant], count = static_cast<int>(model.fruits.size());
  each(Field::fruit_positions, world, first, count, [&](double* to, int f) {
    const auto fallen = simulation::fallen_fruit(simulation, plant, f);
    write(to,
          fallen ? fallen->centre
                 : cosserat::point_on(model, state, model.fruits[f].element, model.fruits[f].back));
  });
  each(Field::fruit_velocities, world, first, count, [&](double* to, int f) {
    const auto fallen = simulation::fallen_fruit(simulation, plant, f);
    write(to, fallen ? fallen->velocity
                     : cosserat::velocity_on(model, state, model.fruits[f].element,
                                             model.fruits[f].back));
  });
}

void StateArrays::fill_organs(const simulation::Simulation& simulation, int world, int plant) {
  const auto& contacts = simulation.plant_step().contacts().organs(plant);
  const int first = layout_.first_organ[plant];
  const int count = static_cast<int>(simulation.rods().model(plant).organs.size());
  each(Field::organ_forces, world, first, count,
       [&](double* to, int o) { write(to, contacts[o].force_W); });
  each(Field::organ_contact_forces, world, first, count,
       [&](double* to, int o) { *to = contacts[o].normal; });
}

void StateArrays::fill_robot(const simulation::RobotControl& robot, int world) {
  const int joints = layout_.rows(Rows::joint);
  const robot::Robot& one = robot.robot();
  each(Field::joint_positions, world, 0, joints,
       [&](double* to, int i) { *to = one.positions()[i]; });
  each(Field::joint_velocities, world, 0, joints,
       [&](double* to, int i) { *to = one.velocities()[i]; });
  each(Field::joint_torques, world, 0, joints,
       [&](double* to, int i) { *to = one.motor_torques()[i]; });
  each(Field::link_poses, world, 0, layout_.rows(Rows::link),
       [&](double* to, int l) { write(to, robot.link_pose(l)); });
  each(Field::tool_pose, world, 0, 1, [&](double* to, int) { write(to, robot.tool_pose()); });
}

void StateArrays::fill_touching(const simulation::Simulation& simulation, int world) {
  const auto& sums = simulation.plant_step().contacts().colliders();
  // What was added since the start are fruits that fell.
  const std::size_t known = std::min(sums.size(), layout_.touching_of.size());
  const int rows = layout_.rows(Rows::touching);
  each(Field::link_forces, world, 0, rows, [&](double* to, int row) {
    Vec3 force = Vec3::Zero();
    for (std::size_t c = 0; c < known; ++c)
      if (layout_.touching_of[c] == row) force += sums[c].force_W;
    write(to, force);
  });
  each(Field::link_contact_forces, world, 0, rows, [&](double* to, int row) {
    *to = 0.0;
    for (std::size_t c = 0; c < known; ++c)
      if (layout_.touching_of[c] == row) *to += sums[c].normal;
  });
}

void StateArrays::fill_energies(const simulation::Simulation& simulation, int world) {
  each(Field::energies, world, 0, 1, [&](double* to, int) {
    std::fill_n(to, 3, 0.0);
    for (int p = 0; p < simulation.rods().size(); ++p) {
      const cosserat::Energy own = cosserat::energy_of(
          simulation.rods().model(p), simulation.rods().state(p), simulation.scene().gravity);
      to[0] += own.kinetic;
      to[1] += own.elastic;
      to[2] += own.gravity;
    }
  });
}

}  // namespace pedicel::app
