#pragma once

#include <span>
#include <utility>
#include <vector>

#include "plugins/cosserat/model/rod_state.h"

namespace pedicel::cosserat {

/// Several plants as one model with a tree for each. It has their elements, organs, fruits, welds
/// and supports one plant after another; of the shapes the stems come first, as finish() makes
/// them. Its clamp stands for none of theirs.
class JoinedModel {
 public:
  /// What belongs to one plant: from which number on, and how many.
  struct Part {
    int first_element = 0, elements = 0;
    int first_organ = 0;
    int first_fruit = 0, fruits = 0;
    int branches = 0;  ///< of a joint, as the plant's own state remembers them
  };
  struct Shape {
    int plant = 0, shape = 0;
  };

  /// The models must be finished; they are only read. Throws UsageError where plants with joint
  /// laws, air or a drift differ in what a model has one of: `gust_frequency`, `stiffness_drift`
  /// and `clock`.
  explicit JoinedModel(std::span<const RodModel* const> plants);

  const RodModel& model() const { return model_; }
  const std::vector<Part>& parts() const { return parts_; }

  /// Strings between places of the plants, by the joined elements.
  void set_strands(std::vector<Strand> strands) { model_.strands = std::move(strands); }

  /// Takes over supports that were moved, added or taken away.
  void read_supports(std::span<const RodModel* const> plants);

  int part_of_element(int element) const;
  Shape part_of_shape(int shape) const;
  /// The number of a plant's shape here.
  int shape(int plant, int shape) const;

  /// From a plant's state, which has its joints' memory, to the joined one, which gets room.
  void gather(int plant, const RodState& from, RodState& joined) const;
  /// Where a plant is in the joined state at the end of a step.
  void scatter(int plant, const RodState& joined, RodState& to) const;
  /// Positions and orientations alone.
  void scatter_poses(int plant, const RodState& joined, RodState& to) const;

 private:
  void add(const RodModel& plant);
  void add_air_and_laws(std::span<const RodModel* const> plants);
  void add_shapes(std::span<const RodModel* const> plants);

  RodModel model_;
  std::vector<Part> parts_;
  int branches_ = 0;  // of a joint
};

}  // namespace pedicel::cosserat
