#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "discrepancy/simulator.h"

namespace pedicel::discrepancy {

/// Stands among the effects of a hypothesis, though no simulator runs it: the spacing, as a share
/// of the plant file's, of the mesh that is in the data or in the modulus that came with them
/// (Corrections). Both were made with some mesh or none, so a fit must be free to choose.
inline constexpr const char* mesh_error = "mesh_error";

/// The value at which an effect vanishes, for the parameters that are its size; `never` for the
/// others.
enum class Vanishes { never, at_zero, at_one, at_infinity, at_nominal };

/// A number of an effect that a fit may change. Fits work on a scaled unknown u: value = scale u,
/// or value = exp(u) for positive quantities whose size is not known (`logarithmic`).
struct FreeParameter {
  int effect = 0;     ///< index into Hypothesis::effects
  std::string name;   ///< of the effect's parameter; "at": of its place; "heading": see below
  int component = 0;  ///< of a vector
  bool logarithmic = false;
  double scale = 1.0;            ///< of the value, where not logarithmic
  double low = 0.0, high = 0.0;  ///< of the value
  std::string unit;
  /// Standard deviation and centre (a value) of a prior on u, where data may leave it open; 0:
  /// none.
  double prior = 0.0, prior_centre = 0.0;
  Vanishes vanishes = Vanishes::never;
  double nominal = 0.0;  ///< the value with which it vanishes `at_nominal`, > 0

  /// What is known of u beforehand, as a standard deviation: the prior's, else a factor of 4.5
  /// either way, or three times the scale of its steps.
  double width() const;
  double to_unknown(double value) const;
  double to_value(double unknown) const;
};

/// A model to be fitted: effects, some of whose numbers are free; forces from outside the list
/// stand among them (force_term.h). The parameter name "heading" of a
/// direction stands for the angle (rad) of a horizontal unit vector.
struct Hypothesis {
  std::string name;  ///< of the cause it stands for; empty: the baseline
  std::vector<plant::Effect> effects;
  std::vector<FreeParameter> free;

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
  /// What the simulator runs of it.
  Variant variant() const;
  /// Of a plain mesh's error; 0 where it is not among the effects.
  double mesh_share() const;
  /// Adds the effects and free parameters of another one behind its own.
  void add(const Hypothesis& other);
  /// The same with its sizes brought nearer to where its effects vanish: `share` 1 changes nothing,
  /// 0 would be no effect at all; beyond 1 it may leave its bounds.
  Hypothesis shrunk(double share) const;
  /// The same with every free value within its bounds.
  Hypothesis bounded() const;
};

}  // namespace pedicel::discrepancy
