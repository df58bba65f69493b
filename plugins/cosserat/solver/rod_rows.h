#pragma once

#include <array>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "pedicel/core/huge_pages.h"
#include "pedicel/core/task_graph.h"
#include "pedicel/cosserat/lanes/diagonal_blocks.h"
#include "pedicel/cosserat/lanes/lane_layout.h"
#include "pedicel/cosserat/model/rod_state.h"
#include "pedicel/cosserat/solver/block_system.h"
#include "pedicel/cosserat/solver/newton_change.h"

namespace pedicel::cosserat {

/// What BDF2 needs of the step before the one that a state ends, one entry an element.
struct RodHistory {
  std::vector<Vec3> position;          ///< m, W
  std::vector<Quat> orientation;       ///< E to W
  std::vector<Vec3> velocity;          ///< m/s, W, of the centre of mass
  std::vector<Vec3> angular_velocity;  ///< rad/s, E
  std::vector<Vec3> stretch, bend;     ///< 1 and rad, E: strains from rest
};

/// What a step needs and leaves nothing in: RodRows that are never stepped at once may share it,
/// and then stay in a core's cache.
class RowScratch {
 public:
  /// `on_huge_pages`: it and what lasts of those RodRows stand on HugePages.
  explicit RowScratch(bool on_huge_pages = false);

 private:
  std::unique_ptr<HugePages> pages_;

 public:
  template <class Row>
  using Rows = std::pmr::vector<Row>;
  std::pmr::memory_resource* const memory;
  Rows<PoseRow> start{memory}, iterate{memory};
  Rows<RateRow> rate{memory};
  Rows<StrainRow> strain{memory};
  Rows<ViscousRow> viscous{memory};
  Rows<TermRow> term{memory};
  Rows<FactorRow> factor{memory};
  Rows<BlocksRow> blocks{memory};
};

/// The incremental potential of some plants over one step, without loads, supports, welds and
/// contact, in rows of eight elements (lanes.h): its value, its gradient with a positive definite
/// Hessian (Gauss-Newton plus the tension's geometric stiffness), and the solution of Newton's
/// system. The order of calls is DirectSolver's. Calls with a pool share the packs out to its
/// threads: branches before what carries them in eliminate(), after it elsewhere.
class RodRows {
 public:
  /// With `keep_blocks` trees are treated as plants with loops are. `threads` is how many the packs
  /// are shared out to.
  RodRows(std::span<const RodModel* const> plants, int threads, bool keep_blocks = false,
          std::shared_ptr<RowScratch> scratch = nullptr);

  /// Reads the constants of a plant (again).
  void read_model(int plant, const RodModel& model);
  /// How a plant steps: backward Euler where `previous_dt` is 0, else BDF2 after a step of that
  /// length (s). Its clamp stands at `root` at the end. Whether prepare() continues the
  /// acceleration of the last step, too.
  void set_scheme(int plant, double dt, double previous_dt, const Pose& root,
                  bool accelerate = false);
  /// What the plant's extensions are in a step that starts at `time` (s). `settled`: in the settled
  /// shape instead, without dashpots, friction sliders and gusts, and at `time` itself. Call it
  /// after read_model() and set_scheme().
  void set_extensions(int plant, const RodModel& model, double time, double dt, bool settled);
  /// By how much of the way the axes that drag is linearised about go to the iterate's, each time.
  void set_axis_share(double share) { axis_share_ = share; }
  /// branch_count() of the plant.
  int branches(int plant) const { return extended_[plant].branches; }
  void set_gravity(const Vec3& gravity);
  /// Which plants the calls below are for, until told otherwise (others may be computed along,
  /// without effect).
  void set_active(std::span<const char> plants);

  /// Adds what a step reads of what was left by the one before.
  void add_to(FetchAhead& ahead) const;
  /// What is fetched along with the rows of the next step; null: nothing.
  void fetch_along(FetchAhead* ahead);

  /// Starts a step from the plants' states, with the motion continued as the iterate; change(plant)
  /// then says how far that turns an element. States that are `unchanged`, by plant, since the last
  /// end_step(), of plants that nothing has come off from, need not be read.
  void prepare(ThreadPool& pool, std::span<const RodState* const> states,
               std::span<const char> unchanged = {});
  /// Sets energy_before() to what the step's start would have, with the clamps where they end, and
  /// energy() to what the first guess has. Writes the iterates as write_iterate() does.
  void compare_start(ThreadPool& pool, std::span<RodState* const> states);
  /// Makes the step's start the iterate of a plant.
  void hold(int plant);
  void read_iterate(int plant, const RodState& state);
  /// Writes the plants' iterates to the states that are given (others: nullptr).
  void write_iterate(ThreadPool& pool, std::span<RodState* const> states);

  /// Newton's system at the iterate, reduced to y and factors (trees) or left as blocks (loops).
  /// What springs and contacts add must have been given since the last call.
  void eliminate(ThreadPool& pool);
  void clear_extras();
  /// The blocks must stay where they are until eliminate() is done.
  void add_extras(int plant, const ElementBlocks& blocks);
  /// The blocks of a plant with loops.
  void copy_blocks(int plant, BlockSystem& system) const;
  void set_change(int plant, const BlockSystem& solved);
  void substitute(ThreadPool& pool);
  /// eliminate(), substitute() and move(true, measured) in one go, where nothing has to happen
  /// between them.
  void solve_and_move(ThreadPool& pool, bool measured, std::span<RodState* const> states);

  /// Moves the iterate from where the line search began by `share` of the change, by lane.
  /// `keep` first makes the iterate that beginning; energy() follows where it is `measured`. Writes
  /// the iterates as write_iterate() does.
  void set_share(int plant, double share);
  void move(ThreadPool& pool, bool keep, bool measured, std::span<RodState* const> states);
  /// Sets energy() where move() did not.
  void measure(ThreadPool& pool);

  /// Ends the step: velocities, written to the plants' states, with the iterate, where there is
  /// one. Then end_step() makes this step the past.
  void finish(ThreadPool& pool, std::span<RodState* const> states);
  void end_step();

  /// Asks for all that the next four tell, so that they need not wait for it one by one.
  void fetch_results() const;
  /// J, where the last move() that was measured led, or of the last measure().
  double energy(int plant) const { return sum(plant, &Pack::energy); }
  /// J, where the last eliminate() was.
  double energy_before(int plant) const { return sum(plant, &Pack::energy_before); }
  bool healthy(int plant) const;
  NewtonChange change(int plant) const;
  Vec6 change(int plant, int element) const;
  /// The element with the largest change, of `elements`.
  int largest_change(int plant, int elements) const;

  /// Gives a plant a past, one step before its state.
  void set_history(int plant, const RodHistory& history);

 private:
  struct Anchor {  // what stands in a lane of a pack's first row: an element of the same plant
    int plant = -1, element = -1;
  };
  // An element that a chain of another pack starts from, and the slot of that pack's first row.
  struct Carrier {
    Slot element, anchor;
  };

  // How a plant's extensions were read last.
  struct Extended {
    bool any = false;
    bool fresh = false;  // the model was read since
    bool settled = false;
    int branches = 0;  // RodState::joint_memory, an element
    double dt = 0.0;   // s
  };

  // How a plant steps (s).
  struct Scheme {
    double dt = 0.0, previous_dt = 0.0;
    bool accelerate = false;
    bool operator==(const Scheme&) const = default;
  };

  RowArrays arrays();
  void make_viscous(int chain);
  void make_extension_rows(int branches);
  void read_extensions(int plant, const RodModel& model);
  void read_branches(int plant, const RodModel& model);
  void mark_extended(int plant, const RodModel& model);
  void read_terms(const JointLaw& law, int row, int lane);
  void read_memory(int plant, const RodState& state, int element, int row, int lane);
  bool has_states(int pack, std::span<const char> unchanged) const;
  void read_states(int pack, std::span<const RodState* const> states);
  // Tasks are those of LaneLayout.
  void eliminate_task(const RowArrays& rows, int task);
  void substitute_task(const RowArrays& rows, int task);
  void move_task(const RowArrays& rows, int task, bool keep, bool measured,
                 std::span<RodState* const> states);
  template <class Do>
  void each_pack(ThreadPool& pool, const Do& todo);
  double sum(int plant, const Lanes Pack::*energy) const;
  void write_pack(int pack, std::span<RodState* const> states) const;
  void write_end(int pack, std::span<RodState* const> states) const;
  template <class Write>
  void for_each_element(int pack, std::span<RodState* const> states, const Write& write) const;
  void place_anchors(int pack, std::span<PoseRow> poses) const;
  void take_anchors(int pack);
  void pass_on_changes(int task);
  void pass_on_poses(int task);

  std::shared_ptr<RowScratch> scratch_;
  LaneLayout layout_;
  TaskGraph graph_;  // of the layout's tasks
  std::vector<Pack> packs_;
  std::vector<char> active_plants_, active_;  // set_active(); by pack
  std::pmr::vector<ElementRow> element_;
  std::pmr::vector<PoseRow> previous_;
  std::pmr::vector<RateRow> previous_rate_;  // between finish() and end_step() the end's
  std::pmr::vector<StrainRow> previous_strain_;
  // Empty unless some plant is extended; branch_: branches_a_row_ a row.
  std::vector<ExtensionRow> extension_;
  std::vector<ExtensionTermRow> extension_term_;
  std::vector<BranchRow> branch_;
  std::vector<JointTermRow> joint_term_;  // empty unless some joint has a term
  int branches_a_row_ = 0;
  double axis_share_ = 1.0;
  std::vector<Extended> extended_;  // by plant
  std::vector<int> first_branch_, first_extra_;
  std::vector<BlockSource> branches_, extras_;
  std::vector<int> extra_rows_;
  std::vector<std::array<Anchor, lane_count>> anchors_;  // by pack
  std::vector<std::vector<Carrier>> carriers_;           // by task
  std::vector<Pose> roots_;                              // X_W of the clamps
  std::vector<Scheme> schemes_;                          // by plant
  std::vector<double> shares_;                           // 1, by plant
  bool keeps_end_ = false;  // of the step before, in `start` and `rate`
  Vec3 gravity_ = Vec3::Zero();
  FetchAhead* ahead_ = nullptr;  // not its own
};

}  // namespace pedicel::cosserat
