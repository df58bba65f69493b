#include "plugins/cosserat/solver/iteration_control.h"

#include <algorithm>
#include <cmath>

namespace pedicel::cosserat {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double tiny = 1.0e-300;  // in place of a divisor of 0

}  // namespace

// gain_change_ may stay: with a gain of 1 nothing is expected of the first iteration.
void IterationControl::reset() {
  is_solved_ = false;
  gain_ = 1.0;
  substepped_in_a_row_ = 0;
}

void IterationControl::begin_step() {
  is_solved_ = false;
  last_change_ = 0.0;
  damped_ = 1.0;
  followed_ = infinity;
}

bool IterationControl::suits_second_order(double dt, double previous_dt) {
  return std::max(dt, previous_dt) <= largest_ratio * std::min(dt, previous_dt);
}

bool IterationControl::is_fast(const NewtonChange& guess) {
  return guess.turn > straight_turn;
}

bool IterationControl::ends_roughly(Pressing pressing, bool converged) const {
  const bool is_unsolved = pressing != Pressing::nothing && !converged;
  return change_.motion() > (is_unsolved ? rough_unsolved_motion : rough_motion);
}

// Contact with things outside is stiff enough to be searched always.
bool IterationControl::is_searched(bool may_touch_outside) const {
  return may_touch_outside || change_.motion() > unsearched_motion;
}

// The change counts in full when it is asked whether the step is done, and with its share when it
// is asked how far the plant went.
void IterationControl::begin_search(const NewtonChange& change, double energy) {
  change_ = change;
  energy_ = energy;
  share_ = std::min(damped_, largest_turn / std::max(change.turn, tiny));
}

bool IterationControl::accepts(double found) const {
  return share_ == 0.0 || found <= energy_ + rounding * (1.0 + std::abs(energy_));
}

// New contacts hold energy that nothing has put in: as much as the known ones hold is taken. At the
// share 0 the potential has not risen.
bool IterationControl::accepts_new_contacts(double found, double known) const {
  return !(found > energy_ + known && share_ > 0.0);
}

bool IterationControl::halve_share() {
  share_ *= 0.5;
  if (share_ >= smallest_share) return true;
  share_ = 0.0;
  return false;
}

bool IterationControl::may_follow_contacts(const RodSettings& settings) {
  followed_ += moved();
  return followed_ <= followed_motion * settings.self_contact_tolerance;
}

// The first iteration of a step has measured nothing yet. It takes the gain of an earlier step,
// larger where the change is larger than then: Newton's gain grows with the change.
double IterationControl::update_gain(bool first) {
  const double change = change_.largest;
  if (first) return gain_ * std::max(1.0, change / std::max(gain_change_, tiny));
  gain_change_ = last_change_;
  return gain_ = change / last_change_;
}

// A step that ends after its first iteration does not measure the gain, which is known the less the
// longer that goes on. Sooner or later a step then takes a second iteration, and measures it.
void IterationControl::trust_gain_less() {
  gain_ = std::pow(gain_, gain_trust);
}

// A contact that moves a stem by many of its radii in one step wants more iterations than a smooth
// motion. Self-contact that gains nothing any more does not want them.
bool IterationControl::is_rough(Pressing pressing, double gain, const RodSettings& settings) const {
  switch (pressing) {
    case Pressing::nothing:
      return false;
    case Pressing::itself:
      return change_.motion() > rough_self_motion * settings.self_contact_tolerance &&
             gain < stalled_gain;
    case Pressing::outside:
      return change_.largest > converged_change;
  }
  return false;
}

// Newton stops when what is left, by the geometric series of its gain an iteration, is below the
// tolerance (Hairer & Wanner, Solving ODEs II, section IV.8).
bool IterationControl::is_done(Pressing pressing, const RodSettings& settings, StepReport& report) {
  ++report.iterations;
  report.last_change = change_.largest;
  const bool first = last_change_ == 0.0;
  const double gain = update_gain(first);
  const double change = last_change_ = change_.largest;
  const bool with_itself = pressing == Pressing::itself;

  // How many iterations this step may take: more where contact moves things roughly, and more again
  // where changes are damped.
  const bool rough = is_rough(pressing, gain, settings);
  int most = (rough ? rough_iterations : 1) * settings.newton_iterations;
  if (damps_cycles_ && rough && !with_itself) {
    if (!first && gain > cycling_gain) damp();
    if (damped_ < 1.0) most *= damped_iterations;
  }
  const bool last = report.iterations >= most;

  // Self-contact leaves its coupling out of the Hessian: what the last iterations would do is below
  // what can be seen, and would cost most of the time.
  const double series = gain < 1.0 ? gain / (1.0 - gain) : infinity;
  const double moved = change_.motion(), left = series * moved;
  const double settled = settings.self_contact_tolerance;
  const bool is_settled = moved <= settled || left <= left_over * settled;
  // Only the last iteration of a step can say that it did not converge. Self-contact is held to
  // what can be seen, everything else to what the next step can start from.
  if (last && (with_itself ? !is_settled : change > converged_change))
    report.errors |= not_converged;
  if (with_itself) {
    is_solved_ = is_settled;
    // The gain of an earlier step may be too good for this one, so it has to leave less.
    const bool ends = first ? left <= left_over_ahead * settled : is_settled;
    if (ends && first) trust_gain_less();
    return last || ends;
  }
  // Contacts with things outside are found anew in every iteration, and the series knows nothing of
  // those that come.
  if (pressing == Pressing::outside)
    return last || change <= pressed_tolerance * settings.tolerance;
  const bool small = change <= settings.tolerance || series * change <= settings.tolerance;
  if (small && first) trust_gain_less();
  is_solved_ = small;
  return last || small;
}

// A stem that lies flat between a link and the ground is touched in one place of each, and both
// roll from end to end as it tilts: Newton's Hessian does not know, its changes go to and fro for
// ever, and neither place is wrong enough for the line search. With the slope -s of what a change
// leaves of the one before it, shares below 2 / (1 + s) converge.
void IterationControl::damp() {
  damped_ = std::max(0.5 * damped_, most_damped);
}

// In a substep, what drags a plant moves less. Nothing drags a plant that touches only itself.
bool IterationControl::needs_substeps(Pressing pressing, const StepReport& report) {
  return (report.errors & not_converged) && pressing == Pressing::outside;
}

void IterationControl::begin_substeps(const IterationControl& whole) {
  damps_cycles_ = whole.substepped_in_a_row_ > most_substepped_in_a_row;
}

}  // namespace pedicel::cosserat
