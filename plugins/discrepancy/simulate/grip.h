#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plugins/cosserat/solver/rod_system.h"
#include "plugins/discrepancy/simulate/guides.h"
#include "plugins/discrepancy/simulate/variant_plant.h"

namespace pedicel::discrepancy {

/// N/m, of a hold that states none: 10 N move its point by a micrometre.
constexpr double rigid_stiffness = 1.0e7;

/// The holds of a trial on one plant, with the effects at the grip.
class Grip {
 public:
  /// `effects`: all; those of other kinds are passed over.
  Grip(const PlantMaker& maker, const cosserat::RodModel& model, const Trial& trial,
       std::span<const plant::Effect> effects);

  /// Adds a support for each hold that holds during a step after `begin` (s), where it is to be at
  /// `t`. Of one that slides that is what leads its orientation.
  void add_supports(double begin, double t, std::vector<cosserat::Support>& supports) const;
  /// Adds what leads the points that slide.
  void add_guides(double begin, double t, std::vector<Guide>& guides) const;
  bool has_guides() const;
  /// The first hold's pull on the plant (N, W) at `t`, as in a step after `begin`.
  Vec3 force(const cosserat::RodModel& model, const cosserat::RodState& state, double begin,
             double t) const;

 private:
  struct Held {
    const Hold* hold = nullptr;
    plant::PlacedPoint place, slipped;
    double slip_time = std::numeric_limits<double>::infinity();  // s
    double stiffness = 0.0;                                      // N/m
    Quat drawn[2] = {Quat::Identity(), Quat::Identity()};        // E to W, of both places
    Vec3 bend_stiffness = Vec3::Zero();                          // N m/rad, about E's axes
  };
  bool holds(const Held& held, double begin) const;
  const plant::PlacedPoint& place(const Held& held, double begin) const;
  cosserat::Support support(const Held& held, double begin, double t) const;
  void add_guides(const Held& held, double begin, double t, std::vector<Guide>& guides) const;

  std::vector<Held> held_;
};

/// s, when a grip slips; nothing where none does.
std::vector<double> slip_times(std::span<const plant::Effect> effects);

}  // namespace pedicel::discrepancy
