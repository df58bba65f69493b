#pragma once

#include <cstdint>
#include <vector>

#include "plugins/simulation/quantities.h"

namespace pedicel::app {

using simulation::Quantity;
using simulation::RowLayout;
using simulation::Rows;

/// The quantities of one or several worlds of a scene as flat arrays, rows first, world by world.
/// Their memory stays where it is from the beginning to the end. Only what was asked for is kept up
/// to date: the rest costs nothing. A quantity is given by its index in simulation::quantities().
class StateArrays {
 public:
  StateArrays(RowLayout layout, int worlds);

  /// From now on fill() writes it. Whether it did not before: then it is to be filled now.
  bool want(std::size_t quantity);
  /// Writes all that is wanted of a world. Worlds may be filled at once.
  void fill(const simulation::Simulation& simulation, int world);

  int worlds() const { return worlds_; }
  const RowLayout& layout() const { return layout_; }
  /// Numbers in all worlds: worlds x rows x columns. Null for a flag.
  double* numbers(std::size_t quantity) { return all_[quantity].numbers.data(); }
  /// The same of a flag: 0 or 1. Null for a number.
  std::uint8_t* flags(std::size_t quantity) { return all_[quantity].flags.data(); }

 private:
  struct Array {
    bool wanted = false;
    std::vector<double> numbers;
    std::vector<std::uint8_t> flags;
  };
  RowLayout layout_;
  int worlds_;
  std::vector<Array> all_;
};

}  // namespace pedicel::app
