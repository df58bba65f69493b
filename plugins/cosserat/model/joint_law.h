#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "engine/core/frames.h"

namespace pedicel::cosserat {

/// A spring beside a joint's own, in series with a dashpot (Maxwell) or with a slider (Jenkins).
/// Its memory z (rad, E) is what the dashpot or the slider has given way by: the spring bends by
/// phi - z.
struct JointBranch {
  static constexpr double never = std::numeric_limits<double>::infinity();
  double share = 0.0;   ///< 1, of the joint's stiffness
  double time = never;  ///< s, relaxation time: z' = (phi - z)/time; infinite: no dashpot
  /// N m, of the bending moment at which the slider slips (twist has no slider); infinite: none.
  /// Where the two bending stiffnesses differ, the moment is measured as sqrt(K_min y.Ky), y the
  /// spring's bend, so that the slider slips at equal energy whichever way it is bent.
  double limit = never;
  bool from_unloaded = false;  ///< z starts at the unloaded shape, not at the settled one
  bool plastic = false;        ///< it carries its share in the settled shape too (yield)
  bool hung = false;           ///< with from_unloaded: z starts at JointLaw::hung instead
  /// 1 or more: the slider gives way little by little (Bouc-Wen): with y = phi - z the spring's
  /// bend and r the one at its limit, dy/dphi = 1 - |y/r|^exponent sign(dphi y). 0: all at once.
  double exponent = 0.0;
};

/// What a joint does beyond a linear elastic spring. With K its bend stiffness, phi its rotation
/// vector from the unloaded shape, o that of the settled shape, its moment conjugate to phi is
///
///   K [elastic phi + deviation phi + anchored o] + sum share K (phi - z) + terms
///
/// The terms are those of effects with a formula of their own (plugins/cosserat/laws/NAME-inl.h), which
/// is elastic. Twist has no slider and no term: what sliders take of `elastic` it keeps.
struct JointLaw {
  double elastic = 1.0;      ///< 1, share of the stiffness that is there in the settled shape too
  double deviation = 0.0;    ///< 1, (negative) what branches with a dashpot lack in the long run
  double anchored = 0.0;     ///< 1, of -deviation, that counts from the settled shape on
  double relaxed = 0.0;      ///< 1, of deviation, that the settled shape lacks too
  Vec3 hung = Vec3::Zero();  ///< rad, phi of the shape in which hung branches relaxed
  std::vector<JointBranch> branches;  ///< those with a slider first
  std::vector<double> terms;          ///< numbers of all terms; empty: all are 0, and add nothing

  /// A number of the term of that effect, by its index in the formula.
  double& term(std::string_view effect, int number = 0);
  /// JointTerm::bit of those whose size is not 0.
  unsigned terms_there() const;
};

/// Adds relaxation by `fraction` of the stiffness with a time (s), which is the instantaneous one:
/// K phi - fraction K q, q' = (phi - o - q)/time (standard linear solid). At the beginning q is 0;
/// o is phi of the settled shape, or zero. Hung, o is zero and q begins at JointLaw::hung.
enum class RelaxationStart { settled, unloaded, hung };
void add_relaxation(JointLaw& law, double fraction, double time,
                    RelaxationStart start = RelaxationStart::settled);

struct RodModel;
struct RodState;

/// Whether some joint of the plant has a branch that begins hung. Such a plant needs its hung shape
/// before anything else: a settled state of what relaxed_for_long() returns, given to
/// keep_hung_shape().
bool is_hung(const RodModel& model);
/// The plant without what its hung branches carry at first.
RodModel relaxed_for_long(RodModel model);
void keep_hung_shape(RodModel& model, const RodState& state);

/// Adds a slider that carries `share` of the stiffness up to a bending moment `limit` (N m); the
/// elastic share falls by as much.
void add_friction(JointLaw& law, double share, double limit);

/// The same with a slider that gives way little by little, by JointBranch::exponent.
void add_hysteresis(JointLaw& law, double share, double limit, double exponent);

/// Makes what is elastic plastic beyond a bending moment `limit` (N m), from the unloaded shape on.
/// Call it last.
void add_yield(JointLaw& law, double limit);

/// Maxwell branches whose loss factor is `loss_factor` from 0.01 to 200 Hz, and whose storage
/// modulus is the elastic one at `frequency` (Hz), about the settled shape.
void add_structural_damping(JointLaw& law, double loss_factor, double frequency = 2.0);

/// Loss factor and storage modulus (per elastic modulus) of a law's dashpots at a frequency (Hz):
/// sum share i w t / (1 + i w t) beside the elastic spring.
struct ComplexModulus {
  double storage = 0.0, loss_factor = 0.0;
};
ComplexModulus modulus_at(const JointLaw& law, double frequency);

/// Moves what has a slider to the front; the order is kept otherwise.
void sort_branches(JointLaw& law);

/// Whether a plant has more than linear elastic joints and Kelvin-Voigt damping: joint laws, air,
/// drift of its stiffness.
bool is_extended(const RodModel& model);

/// Branches that a joint of the plant has at most: entries of RodState::joint_memory an element.
int branch_count(const RodModel& model);

/// 1, what all elastic stiffnesses of a plant are multiplied by at a time (s): drift,
/// 1 + rate (clock + time), not below 0.01.
double stiffness_factor(const RodModel& model, double time);

/// What the memory is while settle() seeks the settled shape: what has yielded stays, and hung
/// branches have relaxed by their shape.
void start_settling(const RodModel& model, RodState& state);

/// Starts the memory of the joints at the state as the settled shape: dashpots and friction sliders
/// rest there (or at the unloaded shape, where a branch says so); what has yielded stays so.
/// settle() does it, and so does the first step of a state that has no memory yet. Allocates.
void start_memory(const RodModel& model, RodState& state);

/// Moment conjugate to phi (N m) and energy (J) of a joint that is bent by `phi` (rad, E), with the
/// state's memory and time, without damping. Energy is up to a constant.
struct JointResponse {
  Vec3 moment = Vec3::Zero();
  double energy = 0.0;
};
JointResponse joint_response(const RodModel& model, const RodState& state, int element,
                             const Vec3& phi);

}  // namespace pedicel::cosserat
