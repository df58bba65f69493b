#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/steer/state_layout.h"

namespace pedicel::app {

/// The state of one or several worlds of a scene as flat arrays, rows first, world by world. Their
/// memory stays where it is from the beginning to the end. Only what was asked for is kept up to
/// date: the rest costs nothing.
class StateArrays {
 public:
  StateArrays(StateLayout layout, int worlds);

  /// From now on fill() writes the field. Whether it did not before: then it is to be filled now.
  bool want(Field field);
  /// Writes all wanted fields of a world. Worlds may be filled at once.
  void fill(const simulation::Simulation& simulation, int world);

  int worlds() const { return worlds_; }
  const StateLayout& layout() const { return layout_; }
  /// Numbers of a field in all worlds: worlds x rows x columns. Null for a flag.
  double* numbers(Field field) { return numbers_[static_cast<std::size_t>(field)].data(); }
  /// The same of a flag: 0 or 1. Null for a number.
  std::uint8_t* flags(Field field) { return flags_[static_cast<std::size_t>(field)].data(); }

 private:
  static constexpr auto fields = static_cast<std::size_t>(Field::count);
  double* row(Field field, int world, int row);
  /// Calls write(numbers of row first + i, i) for i in [0, count), where the field is wanted.
  template <class Write>
  void each(Field field, int world, int first, int count, const Write& write);
  template <class Read>
  void each_flag(Field field, int world, int first, int count, const Read& read);
  void fill_segments(const simulation::Simulation& simulation, int world, int plant);
  void fill_fruits(const simulation::Simulation& simulation, int world, int plant);
  void fill_moving_fruits(const simulation::Simulation& simulation, int world, int plant);
  void fill_organs(const simulation::Simulation& simulation, int world, int plant);
  void fill_robot(const simulation::RobotControl& robot, int world);
  void fill_touching(const simulation::Simulation& simulation, int world);
  void fill_energies(const simulation::Simulation& simulation, int world);

  StateLayout layout_;
  int worlds_;
  std::array<bool, fields> wanted_{};
  std::array<std::vector<double>, fields> numbers_;
  std::array<std::vector<std::uint8_t>, fields> flags_;
};

}  // namespace pedicel::app
