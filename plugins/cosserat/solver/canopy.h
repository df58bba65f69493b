#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "plugins/cosserat/contact/self_contact.h"
#include "plugins/cosserat/model/joined_model.h"
#include "plugins/cosserat/solver/direct_solver.h"
#include "plugins/cosserat/solver/strings.h"

namespace pedicel::cosserat {

/// Plants that touch each other and themselves, solved as one plant of several trees (JoinedModel).
/// So both sides of a contact get the same force in the same step, friction and line search see all
/// plants, and the result depends neither on the order of contacts nor on threads. What they touch
/// beside each other is found plant by plant, as it is without a canopy.
///
/// Strings from one to another are part of that one system, whose blocks then are factorised in
/// place of its lanes: both ends feel one force, and Newton sees both at once.
///
/// The price: all plants take as many iterations as the one that needs most.
class Canopy {
 public:
  using PlantStep = DirectSolver::PlantStep;

  /// For these plants, in this order; what it keeps of them is read again in each step. Without
  /// `contact` they do not touch each other. Throws UsageError where JoinedModel does.
  Canopy(const RodSettings& settings, const std::optional<SelfContactSettings>& contact,
         std::span<const PlantStep> plants, int threads, std::span<const PlantString> strings = {});
  ~Canopy();

  /// Steps all of them. Sources of a plant that find its contact with itself are left out. A report
  /// names the step's errors at the plant whose element changed most, or at all of them.
  void step(std::span<PlantStep> plants, double dt, const Vec3& gravity, ThreadPool& pool);

  /// Of the last step, as RodSolver::contact_forces(): shapes are the plant's own; see touched().
  const std::vector<ContactForce>& contact_forces(int plant) const { return forces_[plant]; }
  /// Whose shape a collider is, one for which is_other_plant() holds.
  JoinedModel::Shape touched(int collider) const;

  void change_settings(const RodSettings& settings);
  /// Only where plants touch each other.
  void change_settings(const SelfContactSettings& settings) { contact_->change_settings(settings); }
  /// Forgets history, after a state was set from outside.
  void reset() { solver_->reset(); }

 private:
  class Sources;

  void read(std::span<const PlantStep> plants);
  void gather(std::span<const PlantStep> plants);
  void join(std::span<const PlantStep> plants);
  void share_out(std::span<PlantStep> plants, const StepReport& report);

  std::unique_ptr<JoinedModel> joined_;
  std::unique_ptr<DirectSolver> solver_;
  // Of the plants with themselves: with each other, too, or each as its own sources find it.
  std::unique_ptr<SelfContact> contact_;
  std::unique_ptr<Sources> own_;
  std::unique_ptr<Sources> sources_;  // all others
  std::vector<PlantString> strings_;
  std::vector<const RodModel*> models_;
  RodState state_;  // of all
  std::vector<Clamp> clamps_;
  std::vector<Load> loads_;
  std::vector<Tie> ties_;
  std::vector<Vec3> air_;
  std::vector<std::vector<ContactForce>> forces_;  // by plant
  bool fresh_ = true;                              // no step has been made
};

}  // namespace pedicel::cosserat
