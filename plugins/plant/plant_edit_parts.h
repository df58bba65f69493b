#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "plugins/plant/plant_file.h"
#include "plugins/plant/stem_tree.h"

/// What the edits of a plant share.
namespace pedicel::plant {

inline constexpr double smallest_gap = 1.0e-6;  ///< m, between neighbouring points of a stem

/// Throws UsageError.
void check_free(const PlantFile& plant, const std::string& name);
void check_fraction(double at);
void check_point(const PlantCurve& curve, int point);
/// Takes a curve off with what is on it; not its branches.
void drop_curve(PlantFile& plant, const std::string& name);

/// Branches keep their place on a stem that is about to change. They are moved, not turned: a
/// branch that was drawn upright stays so.
class BranchesFollow {
 public:
  /// Before the change.
  BranchesFollow(const PlantFile& plant, int stem);
  /// After it, on the same plant.
  void move(PlantFile& plant) const;

 private:
  struct Branch {
    int curve;
    double at;              // 1, on the stem
    Vec3 place;             // m, of the stem there
    std::vector<int> with;  // what hangs on the branch
  };
  int stem_;
  std::vector<Branch> branches_;
};

/// Changes one curve and lets its branches follow. Throws UsageError where the curve is none.
void replace_curve(PlantFile& plant, int index, PlantCurve curve);

/// Copies curves (the first is the stem) with what is on them to other places. The first copy is
/// called `name`, the others get free names.
void copy_stems(PlantFile& plant, const std::vector<int>& curves, const std::string& name,
                const Eigen::Affine3d& motion);

}  // namespace pedicel::plant
