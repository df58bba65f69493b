#pragma once

#include <span>
#include <vector>

#include "plugins/cosserat/model/rod_state.h"
#include "plugins/cosserat/solver/row_extensions.h"

namespace pedicel::cosserat {

/// What BDF2 needs of the step before the one that a state ends, one entry an element.
struct RodHistory {
  std::vector<Vec3> position;          ///< m, W
  std::vector<Quat> orientation;       ///< E to W
  std::vector<Vec3> velocity;          ///< m/s, W, of the centre of mass
  std::vector<Vec3> angular_velocity;  ///< rad/s, E
  std::vector<Vec3> stretch, bend;     ///< 1 and rad, E: strains from rest
};

/// Plants and their states, read into the rows and written from them, and the scheme by which a
/// step goes from one state to the next.
class RowStates {
 public:
  RowStates(RowStore& store, RowExtensions& extensions)
      : store_(store), extensions_(extensions), schemes_(store.clamps.size()) {}

  /// Reads the constants of a plant (again).
  void read_model(int plant, const RodModel& model);
  /// How a plant steps: backward Euler where `previous_dt` is 0, else BDF2 after a step of that
  /// length (s). `clamps`: of each of its trees. Whether prepare() continues the
  /// acceleration of the last step, too.
  void set_scheme(int plant, double dt, double previous_dt, std::span<const Clamp> clamps,
                  bool accelerate = false);
  /// Gives a plant a past, one step before its state.
  void set_history(int plant, const RodHistory& history);

  /// Starts a step from the plants' states, with the motion continued as the iterate; the change of
  /// a plant then says how far that turns an element. States that are `unchanged`, by plant, since
  /// the last end_step(), of plants that nothing has come off from, need not be read.
  void prepare(ThreadPool& pool, std::span<const RodState* const> states,
               std::span<const char> unchanged = {});
  /// Makes the step's start the iterate of a plant.
  void hold(int plant);
  void read_iterate(int plant, const RodState& state);
  /// Writes the plants' iterates to the states that are given (others: nullptr).
  void write_iterate(ThreadPool& pool, std::span<RodState* const> states);
  /// The same of one pack, in the caller's thread.
  void write_pack(int pack, std::span<RodState* const> states) const;

  /// Ends the step: velocities, written to the plants' states, with the iterate, where there is
  /// one. Then end_step() makes this step the past.
  void finish(ThreadPool& pool, std::span<RodState* const> states);
  void end_step();

 private:
  // How a plant steps (s).
  struct Scheme {
    double dt = 0.0, previous_dt = 0.0;
    bool accelerate = false;
    bool operator==(const Scheme&) const = default;
  };

  void read_welds(const RodModel& model, const Chain& chain);
  bool has_states(int pack, std::span<const char> unchanged) const;
  void read_states(int pack, std::span<const RodState* const> states);
  void read_element(const RodState& state, int plant, int element, Slot slot);
  void write_end(int pack, std::span<RodState* const> states) const;
  template <class Write>
  void for_each_element(int pack, std::span<RodState* const> states, const Write& write) const;

  RowStore& store_;
  RowExtensions& extensions_;
  std::vector<Scheme> schemes_;  // by plant
  bool keeps_end_ = false;       // of the step before, in `start` and `rate`
};

}  // namespace pedicel::cosserat
