#pragma once

#include <array>
#include <vector>

#include "plugins/discrepancy/fit/fit.h"

namespace pedicel::discrepancy {

/// An unknown force over one trial: its values at even times from 0 on, linear between them. Its
/// coefficients are [axis][knot], from `first` on.
struct ForceKnots {
  int trial = 0;
  double interval = 0.0;  ///< s
  int count = 0, first = 0;
};

/// What an unknown history in some place does to the data: the normal equations of its coefficients
/// once the model's own parameters have taken their share, from whitened residuals of unit
/// variance. The log-likelihood that a history c gains is right.c - c.normal.c/2.
struct ForceSpace {
  plant::CurvePlace place;
  int marker = -1;
  std::vector<Vec3> axes;  ///< W, of the force: two, across the curve there
  std::vector<ForceKnots> knots;
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
  /// By how much the model's unknowns give way to a coefficient: parameters x coefficients, 1/N.
  Eigen::MatrixXd shift;
  /// A trial of `knots` each: what a coefficient moves the place by, 3 samples x coefficients, m/N.
  std::vector<Eigen::MatrixXd> motion;

  int size() const { return static_cast<int>(right.size()); }
  /// Coefficients of a force, given as (index into `knots`, knot) to N, W.
  template <class Law>
  Eigen::VectorXd coefficients(const Law& law) const {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(size());
    for (std::size_t k = 0; k < knots.size(); ++k)
      for (int i = 0; i < knots[k].count; ++i) {
        const Vec3 force = law(static_cast<int>(k), i);
        for (std::size_t a = 0; a < axes.size(); ++a)
          c[knots[k].first + static_cast<int>(a) * knots[k].count + i] = axes[a].dot(force);
      }
    return c;
  }
};

/// A history of no particular law, by a Gaussian process of some tenths of a second's memory whose
/// size makes the data likeliest (Rasmussen and Williams, Gaussian Processes, 5.4.1). Without any
/// such force it comes out near zero.
struct FreeForce {
  Eigen::VectorXd value;  ///< coefficients
  Eigen::VectorXd error;  ///< their standard deviations
  double evidence = 0.0;  ///< log marginal likelihood above that of none
  double gain = 0.0;      ///< log-likelihood of `value` above that of none
};
FreeForce free_history(const ForceSpace& space);

/// Where a place was and how fast, at the knots: as its marker was seen, and where it was not the
/// model's motion with a force's part added.
struct ForcePath {
  std::vector<Eigen::MatrixXd> position, velocity;  ///< a trial of `knots` each, knots x 3, W
};

/// Simulates what forces at the markers would do to a fitted model.
class ForceResponses {
 public:
  /// `model`: fitted over `options.trials`. `distance`: m between nodes.
  ForceResponses(const Experiment& experiment, const DataSet& data, const FitSummary& model,
                 const FitOptions& options, double distance, int threads,
                 const std::atomic<bool>* stop = nullptr);

  /// Of forces across the curve at a marker.
  ForceSpace force_at(int marker);
  /// Of displacements of the markers that are chosen, all alike, that are the sensor's and not the
  /// plant's; axes x, y, z. Nothing is simulated.
  ForceSpace displacement_of(const std::vector<int>& markers) const;

  ForcePath path(const ForceSpace& space, const Eigen::VectorXd& history) const;
  long simulations() const { return simulator_.simulations(); }

 private:
  std::vector<Vec3> axes_at(int marker) const;
  double push_size(int marker, const std::vector<Vec3>& axes);
  Eigen::MatrixXd simulate(const ForceKnots& knots, double size, ForceSpace& space);
  /// Whitened changes of the data into the normal equations, coupled to the model's parameters.
  /// `coupling`: coefficients x parameters.
  void add(const Eigen::MatrixXd& columns, const ForceKnots& knots, ForceSpace& space,
           Eigen::MatrixXd& coupling) const;
  void finish(ForceSpace& space, const Eigen::MatrixXd& coupling) const;
  ForceSpace prepared(int axes) const;
  Eigen::Index row_of(int trial) const;

  const Experiment& experiment_;
  const DataSet& data_;
  const FitSummary& model_;
  std::vector<int> trials_;
  Variant variant_;
  Simulator simulator_;
  std::vector<ForceKnots> knots_;  // for two axes
  std::vector<Prediction> plain_;  // one a fitted trial
};

}  // namespace pedicel::discrepancy
