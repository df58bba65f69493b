#pragma once

#include <Eigen/Geometry>
#include <array>
#include <compare>
#include <utility>
#include <vector>

#include "pedicel/cosserat/contact/plant_blades.h"

namespace pedicel::cosserat {

/// Where a straight axis and a triangle are nearest.
struct NearestToTriangle {
  double along = 0.5;                       ///< 1, of the axis, 0 at its near end
  Vec3 shares = Vec3::Constant(1.0 / 3.0);  ///< barycentric coordinates
};

/// Minimises |a(s) - T(w)|^2 + e ((s - 1/2)^2 + |w - 1/3|^2) over axis and triangle, with e = 1e-4
/// times the larger one's size squared, as nearest_fractions() does: unique, and continuous where
/// the axis lies flat on the triangle. An axis may be a point. Lengths in m, any frame.
NearestToTriangle nearest_to_triangle(const Vec3& start, const Vec3& along,
                                      const std::array<Vec3, 3>& corners);

/// Contacts of leaf blades with the stems, veins and fruits of other plants that are solved as one
/// (JoinedModel): a triangle of a blade and a capsule where they are nearest. Blades touch blades
/// where the margin or a vein of one meets the triangle of the other.
///
/// Both sides meet a virtual plane in the middle, as in SelfContact, whose progressive spring and
/// bounds of stiffness these are. The blade's side is shared out to its three corners by the
/// place's barycentric coordinates, and each share is a pair of contacts with one force: so
/// momentum balances pair by pair, and the three forces on the blade stand at the place.
///
/// An axis that went through a blade since the step's start is pushed back to the side where it
/// was. One that was through already is let alone, and so are pairs that overlap as drawn by more
/// than the margin. A plant's blades do not touch the plant itself.
class BladeContact : public ContactSource {
 public:
  struct Plant {
    int first_element = 0, elements = 0;  ///< of the joined model
    const PlantBlades* blades = nullptr;  ///< null: it has none
  };
  /// The model must be finished; it is only read here, not kept. The blades must outlive it.
  BladeContact(const RodModel& joined, std::vector<Plant> plants);

  bool is_within_plant() const override { return true; }
  /// `start` must stay as it is until the step's last find().
  void begin_step(const RodModel& model, const RodState& start, double dt) override;
  void find(const RodModel& model, const RodState& state, double dt,
            std::vector<ContactPoint>& found) override;

 private:
  struct Face {
    int plant = 0;
    BladeTriangle corners;  // by joined elements
  };
  // Faces of one leaf: from `first` to before `last`.
  struct Leaf {
    int plant = 0, first = 0, last = 0;
  };
  using Box = Eigen::AlignedBox3d;  // m, W
  struct Candidate {
    int face = 0, shape = 0;
    auto operator<=>(const Candidate&) const = default;
  };

  // How a pair touches.
  struct Touch {
    NearestToTriangle at;
    double back = 0.0, radius = 0.0, gap = 0.0;  // m, of the capsule there; between the surfaces
    Vec3 normal_W = Vec3::UnitZ();               // unit, from the blade to the capsule
    std::array<Vec3, 3> motion_W;                // m, over the step: of the middle between the
                                                 // capsule there and each corner
  };

  void add_faces(const RodModel& joined, int plant);
  bool is_covered(const RodModel& model, const RodState& state) const;
  void rebuild(const RodModel& model, const RodState& state);
  void meet(const RodState& state, const Leaf& leaf, int plant);
  Box way_of(const RodState& state, const Face& face) const;
  Box way_of(const RodModel& model, const RodState& state, int shape) const;
  void touch(const RodModel& model, const RodState& state, double dt, const Candidate& pair,
             std::vector<ContactPoint>& found) const;
  void add_sides(const RodModel& model, double dt, const Candidate& pair, const Touch& touch,
                 std::vector<ContactPoint>& found) const;

  std::vector<Plant> plants_;
  std::vector<std::vector<int>> shapes_;  // by plant
  std::vector<Face> faces_;
  std::vector<Leaf> leaves_;
  const RodState* start_ = nullptr;  // of the step
  // What may touch while no end of an element is farther from `reference_` than half of the skin.
  std::vector<Candidate> candidates_, left_out_;  // ascending
  std::vector<std::pair<Vec3, Vec3>> reference_;  // m, W, near and far ends, by element
  bool start_is_covered_ = false;                 // by the candidates
  std::vector<Box> shape_ways_, plant_ways_;      // scratch
};

}  // namespace pedicel::cosserat
