#pragma once

#include <optional>
#include <span>

#include "plugins/cosserat/solver/block_system.h"
#include "plugins/cosserat/solver/rod_solver.h"
#include "plugins/discrepancy/simulate/guides.h"

namespace pedicel::discrepancy {

/// The slowest small vibrations of a plant about an equilibrium, without damping, slowest first.
struct Modes {
  /// 6 rows an element: how its child node goes (m) and how it turns (rad), W. The node that goes
  /// farthest goes 1 m.
  Eigen::MatrixXd shape;
  Eigen::VectorXd frequency;  ///< rad/s
  Eigen::VectorXd decay;      ///< 1/s, of the amplitude: Kelvin-Voigt and mass damping

  int size() const { return static_cast<int>(frequency.size()); }
};

/// The plant's stiffness about a state in equilibrium.
class Stiffness {
 public:
  Stiffness(const cosserat::RodModel& model, const cosserat::RodState& state, const Vec3& gravity,
            std::span<const cosserat::Load> loads, std::span<const Guide> guides);

  /// Displacements (rows as in Modes) under forces and moments (N, N m, W, likewise); nothing where
  /// the plant is not stable there.
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& forces) const;

 private:
  cosserat::BlockSystem system_;
  int elements_;
};

/// The first `count` modes; fewer, or none, where the plant has no more or is not stable.
Modes modes_of(const cosserat::RodModel& model, const cosserat::RodState& state,
               const Stiffness& stiffness, int count);

}  // namespace pedicel::discrepancy
