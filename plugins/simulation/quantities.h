#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pedicel::simulation {

class Simulation;

/// What the rows of a quantity count.
enum class Rows { one, segment, fruit, organ, joint, link, body, touching };
inline constexpr int row_kinds = 8;
/// "segments", for people.
std::string_view name_of(Rows rows);

/// What the rows are: the same as long as a scene is the same.
struct RowLayout {
  explicit RowLayout(const Simulation& simulation);
  bool operator==(const RowLayout&) const = default;

  int rows(Rows kind) const { return static_cast<int>(names[static_cast<int>(kind)].size()); }
  const std::vector<std::string>& of(Rows kind) const { return names[static_cast<int>(kind)]; }

  std::array<std::vector<std::string>, row_kinds> names;
  std::vector<int> segment_organ;   ///< index of an organ, by segment
  std::vector<int> segment_parent;  ///< segment that it starts from, by segment; -1: clamped
  std::vector<int> first_segment;   ///< by plant, and the number of all segments behind them
  std::vector<int> first_fruit;     ///< likewise
  std::vector<int> first_organ;     ///< likewise
  std::vector<int> touching_of;     ///< row of Rows::touching, by collider of the scene's start
};

/// A row of a simulation.
struct Row {
  const Simulation& simulation;
  const RowLayout& layout;
  int plant = 0;  ///< of a segment, fruit or organ
  int index = 0;  ///< in its plant; of others in their list
};

/// A quantity of a simulation: described and read here alone. Python's arrays with their stubs and
/// pages, log.csv, topics, the window's plots and scripts walk quantities().
struct Quantity {
  std::string_view name;  ///< of Python's array; empty: it has none
  Rows rows = Rows::one;
  int columns = 1;        ///< 1: an array with one axis (a scalar has Rows::one)
  std::string_view unit;  ///< one of known_units(), or several, for people
  bool flag = false;      ///< true or false, not a number
  std::string_view sentence;
  void (*read)(const Row& row, double* to);
  /// Its columns in log.csv, where * is the row's name, and - one that is not there. Of a joint the
  /// second is for those that slide.
  std::string_view log{};
  bool of_robot = false;  ///< without a robot it has no column
  /// Its values on a topic: of joints on /joint_states, of organs and fruits on /organ_forces.
  std::string_view topic{};
};
std::span<const Quantity> quantities();
/// Calls take(row, number of the row) for every row of a kind.
template <class Take>
void each_row(const Simulation& simulation, const RowLayout& layout, Rows kind, const Take& take) {
  const std::vector<int>* first = kind == Rows::segment ? &layout.first_segment
                                  : kind == Rows::fruit ? &layout.first_fruit
                                  : kind == Rows::organ ? &layout.first_organ
                                                        : nullptr;
  for (int row = 0, plant = 0; row < layout.rows(kind); ++row) {
    while (first && row >= (*first)[static_cast<std::size_t>(plant) + 1]) ++plant;
    take(Row{simulation, layout, plant,
             first ? row - (*first)[static_cast<std::size_t>(plant)] : row},
         row);
  }
}

}  // namespace pedicel::simulation
