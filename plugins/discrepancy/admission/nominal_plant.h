#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "plugins/discrepancy/data/experiment.h"
#include "plugins/plant/plant_builder.h"

namespace pedicel::discrepancy {

/// A measured point: where the nominal plant has it, and how far along the plant it is.
struct Spot {
  plant::PlacedPoint point;
  Vec3 drawn = Vec3::Zero();    ///< m, W, as drawn
  Vec3 settled = Vec3::Zero();  ///< m, W, under gravity
  double from_root = 0.0;       ///< m along the plant
};

/// Where the nominal plant stands. Rods hardly stretch: two points of it are never farther from
/// each other than the way along the plant.
class NominalPlant {
 public:
  /// Nothing where the plant cannot be built; that is for others to say.
  /// `gravity` (m/s2, W) is a trial's: a plant may be turned between trials.
  static std::optional<NominalPlant> of(const Experiment& experiment, const Vec3& gravity);

  const std::vector<Spot>& markers() const { return markers_; }  ///< in the experiment's order
  Spot spot(const plant::CurvePlace& place) const;
  /// m along the plant, from one to the other.
  double along(const Spot& a, const Spot& b) const;
  /// m/N, of a small force at a place of the settled plant; NaN where none is found. Found once for
  /// each place; not for several threads at a time.
  const Mat3& compliance(const Spot& spot) const;
  double mass() const { return mass_; }       ///< kg, of the plant
  const Vec3& root() const { return root_; }  ///< m, W
  double reach() const { return reach_; }     ///< m, to the end that is farthest from the root

 private:
  NominalPlant(const Experiment& experiment, const Vec3& gravity);

  Mat3 find_compliance(const Spot& spot) const;

  plant::PlantFile file_;
  plant::BuiltPlant built_;
  cosserat::RodState drawn_, settled_;
  std::vector<double> far_;  // m from the root to each element's child node
  std::vector<Spot> markers_;
  Vec3 root_ = Vec3::Zero();
  Vec3 gravity_ = Vec3::Zero();  // m/s2
  double reach_ = 0.0, mass_ = 0.0;
  mutable std::map<std::pair<int, double>, Mat3> compliances_;  // by element and place on it
};

}  // namespace pedicel::discrepancy
