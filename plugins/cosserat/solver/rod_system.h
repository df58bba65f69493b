#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/core/state_hash.h"
#include "engine/core/thread_pool.h"
#include "plugins/cosserat/contact/self_contact_settings.h"
#include "plugins/cosserat/model/joined_model.h"
#include "plugins/cosserat/solver/detachment.h"
#include "plugins/cosserat/solver/strings.h"
#include "plugins/cosserat/solver/rod_solver.h"

namespace pedicel::cosserat {

/// All the plants of a world, stepped side by side, or where they touch or hold each other as one.
/// Any number of threads gives the same bits.
class RodSystem {
 public:
  /// What solves the plants of several systems side by side (JoinedSystems).
  class Joint {
   public:
    virtual ~Joint() = default;
    /// A system has come to where it would solve its plants.
    virtual void solve(const RodSystem& system, double dt, const Vec3& gravity) = 0;
    virtual const std::vector<ContactForce>& contact_forces(const RodSystem& system,
                                                            int plant) const = 0;
    virtual void reset(const RodSystem& system, int plant) = 0;
  };

  explicit RodSystem(const RodSettings& settings, int threads = 1);
  ~RodSystem();

  /// Adds a finished model, at rest in its drawn shape. Returns its index.
  int add_plant(RodModel model);
  /// What a plant may touch. The source must be this plant's own: plants are stepped at once.
  void add_contact_source(int plant, std::unique_ptr<ContactSource> source);

  /// From the next step on plants touch each other and themselves (Canopy). Throws UsageError for a
  /// solver that cannot do so.
  void let_plants_touch(const SelfContactSettings& settings);
  /// Whose shape a contact's collider is, one for which is_other_plant() holds.
  JoinedModel::Shape touched(int collider) const;

  /// Advances every plant by dt, then takes off the fruits whose joint passed a threshold.
  void step(double dt, const Vec3& gravity);

  SolverKind solver() const { return settings_.solver; }
  int size() const { return static_cast<int>(plants_.size()); }
  const RodModel& model(int plant) const { return plants_[plant].model; }
  const RodState& state(int plant) const { return plants_[plant].state; }
  /// To change it between two steps; take the reference anew after each. What stays as it was is
  /// better read through model().
  RodModel& edit_model(int plant) {
    plants_[plant].model_changed = true;
    return plants_[plant].model;
  }
  /// To change it between two steps. Set `previous_dt` to 0 with anything but the clamp's pose.
  RodState& edit_state(int plant) {
    plants_[plant].state_changed = true;
    return plants_[plant].state;
  }
  /// Goes on with other constants: stiffness, mass, rest shape, thresholds. The model has the same
  /// elements (parents, drawn shape), organs and fruits, and no joint laws. Supports are its own.
  /// Throws UsageError where it is another plant.
  void change_constants(int plant, RodModel model);
  /// Goes on with other settings of the same solver. Throws UsageError for another solver.
  void change_settings(const RodSettings& settings);
  /// Supports, to move, add or take away between two steps: nothing else of the model is read anew.
  /// They are of the model that add_plant() was given, then its own.
  std::vector<Support>& supports(int plant) { return plants_[plant].model.supports; }
  /// Loads that act until they are changed.
  std::vector<Load>& loads(int plant) { return plants_[plant].loads; }

  /// Strings that hold it until they are changed (direct solver only).
  std::vector<Tie>& ties(int plant) { return plants_[plant].ties; }
  const std::vector<Tie>& ties(int plant) const { return plants_[plant].ties; }

  /// From the next step on that string holds its two plants together: all plants are then solved as
  /// one (Canopy). Returns its index in strings(). Throws UsageError for a solver that cannot do
  /// so, for a place that is not there, and where both ends are on one element.
  int add_string(const PlantString& string);
  const std::vector<PlantString>& strings() const { return strings_; }

  /// m/s, W: the air about each element, in place of what its model says, until it is changed;
  /// empty: as the model says (direct solver only).
  std::vector<Vec3>& air(int plant) { return plants_[plant].air; }

  /// task(plant) for all of them, on the threads that step them. Tasks must not depend on each
  /// other.
  template <class Task>
  void each_plant(const Task& task) const {
    if (size() == 1)
      task(0);
    else
      pool_.for_each(size(), task);
  }

  const StepReport& report(int plant) const { return plants_[plant].report; }
  const std::vector<ContactForce>& contact_forces(int plant) const;
  /// Fruits of a plant that came off in the last step.
  const std::vector<DetachEvent>& detached(int plant) const { return plants_[plant].detached; }

  /// Replaces the state of a plant and forgets its solver's history.
  void set_state(int plant, const RodState& state);

  void add_to(StateHash& hash) const;

 private:
  struct Plant {
    RodModel model;
    RodState state;
    std::unique_ptr<RodSolver> solver;  // position-based: one a plant
    int bed = -1;
    bool model_changed = false, state_changed = true;
    std::vector<std::unique_ptr<ContactSource>> sources;
    std::vector<ContactSource*> source_pointers;
    std::vector<Load> loads;
    std::vector<Tie> ties;
    std::vector<Vec3> air;
    StepReport report;
    std::vector<DetachEvent> detached;
    StalkStart stalks;
  };
  friend class JoinedSystems;
  struct Work;  // what solves the plants (solver_work.h)

  void solve(double dt, const Vec3& gravity);

  RodSettings settings_;
  mutable ThreadPool pool_;
  std::vector<Plant> plants_;
  std::optional<SelfContactSettings> touching_;
  std::vector<PlantString> strings_;
  Joint* joint_ = nullptr;  // solves in place of `work_`; null: nobody
  std::unique_ptr<Work> work_;
};

/// m, W, of one end of a string now; nothing where that came off.
std::optional<Vec3> place_of(const RodSystem& system, const PlantString::End& end);
/// N, with which a string pulls now.
double tension(const RodSystem& system, const PlantString& string);

}  // namespace pedicel::cosserat
