#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "plugins/discrepancy/simulate/simulator.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::discrepancy {

/// Stands among the effects of a hypothesis, though no simulator runs it: the spacing, as a share
/// of the plant file's, of the mesh that is in the data or in the modulus that came with them
/// (Corrections). Both were made with some mesh or none, so a fit must be free to choose.
inline constexpr const char* mesh_error = "mesh_error";

using effects::FreeParameter;
using effects::Vanishes;

/// A model to be fitted: effects, some of whose numbers are free; forces from outside the list
/// stand among them (force_term.h).
struct Hypothesis {
  std::string name;  ///< of the cause it stands for; empty: the baseline
  std::vector<plant::Effect> effects;
  std::vector<FreeParameter> free;

  Hypothesis() = default;
  /// Of one effect, whose name it has.
  Hypothesis(const effects::Start& start);

  int size() const { return static_cast<int>(free.size()); }
  double value(int parameter) const;
  void set_value(int parameter, double value);
  /// Values of the free parameters as unknowns, and back.
  Eigen::VectorXd unknowns() const;
  void set_unknowns(const Eigen::VectorXd& unknowns);
  Eigen::VectorXd low() const;
  Eigen::VectorXd high() const;
  /// Index of the free factor on modulus, density or damping time, -1 where there is none.
  int factor_on(const std::string& parameter) const;
  int factor_on(plant::MaterialRole role) const;
  /// What the simulator runs of it.
  Variant variant() const;
  /// Of a plain mesh's error; 0 where it is not among the effects.
  double mesh_share() const;
  /// Adds the effects and free parameters of another one behind its own.
  void add(const Hypothesis& other);
  /// The same without one of its effects and the effect's free parameters.
  Hypothesis without(int effect) const;
  /// The same with its sizes brought nearer to where its effects vanish: `share` 1 changes nothing,
  /// 0 would be no effect at all; beyond 1 it may leave its bounds.
  Hypothesis shrunk(double share) const;
  /// The same with every free value within its bounds.
  Hypothesis bounded() const;
};

}  // namespace pedicel::discrepancy
