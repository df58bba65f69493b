#pragma once

#include <limits>

#include "plugins/cosserat/solver/newton_change.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// What presses on a plant in an iteration.
enum class Pressing {
  nothing,
  itself,   ///< only another part of the same plant
  outside,  ///< at least one thing that is not part of it
};

/// Decides for one plant how a step and its iterations go on: the order of the scheme, how much of
/// Newton's change is made, which contacts stay, and when the step is solved. It computes nothing
/// of the plant itself. All thresholds of the iteration stand here, each with its reason.
///
/// "Motion" is NewtonChange::motion(), in rad or element lengths: both say how much the geometry of
/// an element has changed, whatever its size.
class IterationControl {
 public:
  /// Substeps of a step that contact keeps from its solution. Two are enough mostly: what drags the
  /// plant then moves half as far. What two do not solve is reported.
  static constexpr int substeps = 2;

  /// Nothing is known of earlier steps any more.
  void reset();
  void begin_step();

  // The scheme and the first guess.

  /// Whether a step of `dt` after one of `previous_dt` (s) can be of second order.
  static bool suits_second_order(double dt, double previous_dt);
  /// Whether the first guess continues the last step's acceleration, too: that step was solved to
  /// the tolerance.
  bool continues_acceleration() const { return is_solved_; }
  /// Whether a first guess turns elements so far that the step's start may be the better one.
  static bool is_fast(const NewtonChange& guess);
  /// Whether the next step must be of first order, because this one ended roughly.
  bool ends_roughly(Pressing pressing, bool converged) const;

  // The line search.

  /// Whether the potential is computed where the change leads. Before the first change of a step is
  /// known, that of the step before stands for it.
  bool is_searched(bool may_touch_outside) const;
  /// `energy`: J, where the search begins. Sets share().
  void begin_search(const NewtonChange& change, double energy);
  /// 1, of Newton's change that is tried.
  double share() const { return share_; }
  /// Whether the search ends where the potential is `found` (J).
  bool accepts(double found) const;
  /// The same with contacts that were found there. `known`: J, of the contacts known before.
  bool accepts_new_contacts(double found, double known) const;
  /// Tries half of the share. False where that is too little: the share then is 0.
  bool halve_share();
  const NewtonChange& change() const { return change_; }

  // Contacts.

  /// Whether this iteration moved so far that contacts must be found again where it ended.
  bool must_find_contacts_again() const { return moved() > unforeseen_motion; }
  void contacts_were_found() { followed_ = 0.0; }
  /// Whether contacts of the plant with itself may be followed to where this iteration ended,
  /// instead of being found again. Call it once an iteration.
  bool may_follow_contacts(const RodSettings& settings);

  // The end of the iteration.

  /// Whether this iteration is the last one. Counts it, and sets `not_converged` where it is not
  /// good enough.
  bool is_done(Pressing pressing, const RodSettings& settings, StepReport& report);

  // Substeps.

  /// Whether a step has to be taken again in substeps.
  static bool needs_substeps(Pressing pressing, const StepReport& report);
  void count_substepped() { ++substepped_in_a_row_; }
  void count_whole() { substepped_in_a_row_ = 0; }
  /// For the substeps of a step that `whole` controls.
  void begin_substeps(const IterationControl& whole);

 private:
  double moved() const { return share_ * change_.motion(); }
  double update_gain(bool first);
  void trust_gain_less();
  bool is_rough(Pressing pressing, double gain, const RodSettings& settings) const;
  void damp();

  // Thresholds. "Motion" is in rad or element lengths.

  /// rad, of one Newton change. Beyond it the quadratic model is void: it takes rotations as
  /// vectors, whose sine is off by a sixth there.
  static constexpr double largest_turn = 1.0;
  /// rad. The first guess moves nodes along straight lines. What turns by this is off its arc by
  /// half the square, 5e-4 of its length; more than that strains the rods for nothing.
  static constexpr double straight_turn = 0.03;
  /// Motion. What the quadratic model leaves out of a smaller change is too little to climb by, and
  /// computing the potential takes longer than the move itself.
  static constexpr double unsearched_motion = 0.03;
  /// 1, the least share that is tried. After twelve halvings a direction that does not descend is
  /// one of rounding errors.
  static constexpr double smallest_share = 1.0 / 4096.0;
  /// 1, of the energy and of a joule: rounding of the sum is the only ascent allowed.
  static constexpr double rounding = 1.0e-12;
  /// Two steps' lengths for BDF2, larger over smaller. The scheme is stable below 2.41.
  static constexpr double largest_ratio = 2.0;

  /// Motion. A plant that moves further in one iteration may end deep in what it was not near
  /// before.
  static constexpr double unforeseen_motion = 0.1;
  /// Times RodSettings::self_contact_tolerance. Normals are off by about the motion since they were
  /// found: at the default tolerance by 0.1 rad, whose cosine is off by half a percent.
  static constexpr double followed_motion = 20.0;

  /// m or rad. A contact with things outside is rough while an iteration still changes more.
  static constexpr double converged_change = 1.0e-3;
  /// 1, times RodSettings::tolerance. Contacts are found anew in every iteration, so that a small
  /// change is not yet the end: only one at rounding is.
  static constexpr double pressed_tolerance = 1.0e-4;
  /// Times RodSettings::newton_iterations, where contact is rough. A contact that moves a stem by
  /// many of its radii takes that many more; cut short, the stem may end inside a thin link.
  static constexpr int rough_iterations = 4;
  /// Motion. A step whose last iteration moved more is not on a smooth path. The second-order
  /// scheme continues that path, and would feed on it.
  static constexpr double rough_motion = 0.3;
  /// The same of a step that contact kept from its solution: less is certain there.
  static constexpr double rough_unsolved_motion = 0.1;

  /// Times RodSettings::self_contact_tolerance: self-contact is rough while elements move more.
  static constexpr double rough_self_motion = 10.0;
  /// 1. Self-contact leaves its coupling out of the Hessian. At such a gain what is left would take
  /// more iterations than a step is given, so that more of them do not help.
  static constexpr double stalled_gain = 0.9;
  /// Times RodSettings::self_contact_tolerance, of what is left by the series.
  static constexpr double left_over = 0.6;
  /// The same by the gain of an earlier step, which may have changed: a third of it.
  static constexpr double left_over_ahead = 0.2;

  /// Steps in a row that are taken in substeps before what goes to and fro is damped. What slides
  /// over an edge is mostly through by then, and damping would slow it down.
  static constexpr int most_substepped_in_a_row = 10;
  /// 1. With such a gain changes go to and fro instead of getting smaller.
  static constexpr double cycling_gain = 0.95;
  /// 1, the least that damping leaves of a change. At the default of 4 iterations a step then has
  /// 32, which go seven eighths of the way.
  static constexpr double most_damped = 1.0 / 16.0;
  /// Times as many iterations, because damped ones go less far.
  static constexpr int damped_iterations = 2;
  /// 1, the power that a gain is raised to by a step that did not measure it. So it goes towards 1,
  /// where nothing is trusted: in ten steps from 0.01 to 0.6.
  static constexpr double gain_trust = 0.8;

  // Of this iteration.
  NewtonChange change_;
  double energy_ = 0.0;  // J, where the line search began
  double share_ = 0.0;   // 1
  // Of this step.
  double last_change_ = 0.0;  // m or rad, of the iteration before; 0: there was none
  double damped_ = 1.0;       // 1, the largest share
  double followed_ = std::numeric_limits<double>::infinity();  // motion since contacts were found
  // Of earlier steps, too.
  bool is_solved_ = false;       // the last one, to the tolerance
  double gain_ = 1.0;            // 1, what an iteration leaves of the change before it
  double gain_change_ = 0.0;     // m or rad, the change at which that was measured
  int substepped_in_a_row_ = 0;  // in a row
  bool damps_cycles_ = false;    // of substeps only
};

}  // namespace pedicel::cosserat
