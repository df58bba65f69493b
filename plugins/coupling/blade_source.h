#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "plugins/cosserat/contact/contact.h"
#include "plugins/coupling/collider.h"
#include "plugins/coupling/coupling_settings.h"

namespace pedicel::coupling {

/// A corner of a blade's triangle: a place on an element of the plant.
struct BladeCorner {
  int element = 0;
  double back = 0.0;  ///< m, from the child node
};
using BladeFace = std::array<BladeCorner, 3>;

inline constexpr double blade_half_thickness = 1.5e-4;  ///< m

/// Contacts of a plant's leaf blades with the shared colliders: at most one place for each pair of
/// a triangle and a collider, where the triangle is nearest.
///
/// The place is known to 1/256 of the triangle's size. What presses there is shared out to the
/// three corners by the place's barycentric coordinates: a force that stands at the place, to
/// rounding, and three contacts that each act on one element.
///
/// Veins and margin are capsules by themselves (ColliderSource). Blades do not touch blades or
/// stems.
class BladeSource : public cosserat::ContactSource {
 public:
  /// Keeps a reference to `colliders`, which must outlive it and must not change during a step.
  /// Faces of one leaf follow each other. Throws UsageError where a setting is out of its bounds.
  BladeSource(const ColliderSet& colliders, const CouplingSettings& settings,
              std::vector<BladeFace> faces);

  /// Leaves out for good every pair that overlaps in this state. Adds to what is left out already.
  void ignore_touching(const cosserat::RodModel& model, const cosserat::RodState& state);
  /// Goes on with other settings. Throws UsageError where one is out of its bounds.
  void change_settings(const CouplingSettings& settings);

  void cover(double from, double to) override;
  void begin_step(const cosserat::RodModel& model, const cosserat::RodState& start,
                  double dt) override;
  void find(const cosserat::RodModel& model, const cosserat::RodState& state, double dt,
            std::vector<cosserat::ContactPoint>& found) override;

 private:
  using Corners = std::array<Vec3, 3>;
  // Faces of one leaf.
  struct Leaf {
    int first = 0, last = 0;  // `last` excluded
  };
  struct Motion {
    Pose X_WC, X_WC_before;
  };
  void find_leaves(const cosserat::RodModel& model);
  bool place(const cosserat::RodState& state, int face, Corners& now_W, Corners& before_W) const;
  void touch(int face, int collider, const Corners& now_W, const Corners& before_W,
             std::vector<cosserat::ContactPoint>& found) const;
  Motion motion(int collider) const;

  const ColliderSet& colliders_;
  CouplingSettings settings_;
  std::vector<BladeFace> faces_;
  std::vector<Leaf> leaves_;  // found by the first step
  std::vector<Vec3> start_position_;
  std::vector<Quat> start_orientation_;
  std::vector<std::pair<int, int>> ignored_;  // (face, collider), ascending
  double from_ = 0.0, to_ = 1.0;              // cover()
};

/// The place of a triangle that is nearest to a field, as barycentric coordinates: of places
/// equally near the one nearest to the middle. Nothing where the triangle is farther than `reach`
/// (m).
std::optional<Vec3> nearest_on_triangle(const geometry::SignedDistance& field,
                                        const std::array<Vec3, 3>& corners_C, double reach);

}  // namespace pedicel::coupling
