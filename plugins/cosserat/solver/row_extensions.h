#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/model/rod_model.h"
#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/row_store.h"

namespace pedicel::cosserat {

/// Joint laws, air and drift in the rows (lanes.h: ExtensionRow, BranchRow). A plant without them
/// costs nothing.
class RowExtensions {
 public:
  RowExtensions(RowStore& store, std::size_t plants) : store_(store), plants_(plants) {}

  /// Reads the constants of a plant (again).
  void read_model(int plant, const RodModel& model);
  /// What the plant's extensions are in a step that starts at `time` (s). `settled`: in the settled
  /// shape instead, without dashpots, friction sliders and gusts, and at `time` itself. Call it
  /// after read_model() and set_scheme(). `air`: m/s, W, of each element, in place of the mean wind
  /// and the gusts of the model; empty: those.
  void begin_step(int plant, const RodModel& model, double time, double dt, bool settled,
                  std::span<const Vec3> air = {});
  /// branch_count() of the plant.
  int branches(int plant) const { return plants_[plant].branches; }
  /// What the joint of an element remembers, from a state and to it.
  void read_memory(int plant, const RodState& state, int element, Slot slot);
  void write_memory(int plant, RodState& state, int element, Slot slot) const;
  /// An element came off, whose air nobody computes any more.
  void remove(Slot slot);

 private:
  // How a plant's extensions were read last.
  struct Extended {
    bool any = false;
    bool fresh = false;  // the model was read since
    bool settled = false;
    int branches = 0;  // RodState::joint_memory, an element
    double dt = 0.0;   // s
  };

  void mark_packs(int plant, const RodModel& model);
  void read_branches(int plant, const RodModel& model);
  void read_terms(const JointLaw& law, Slot slot);

  RowStore& store_;
  std::vector<Extended> plants_;
};

}  // namespace pedicel::cosserat
