#pragma once

#include <Eigen/Geometry>
#include <array>
#include <compare>
#include <utility>
#include <vector>

#include "plugins/cosserat/contact/axis_and_triangle.h"
#include "plugins/cosserat/contact/plant_blades.h"

namespace pedicel::cosserat {

/// Contacts of leaf blades with the stems, veins and fruits of other plants that are solved as one
/// (JoinedModel): a triangle of a blade and a capsule where they are nearest. Blades touch blades
/// where the margin or a vein of one meets the triangle of the other.
///
/// Both sides meet a virtual plane in the middle, as in SelfContact, whose progressive spring and
/// bounds of stiffness these are. The blade's side is shared out to its three corners by the
/// place's barycentric coordinates, and each share is a pair of contacts with one force: so
/// momentum balances pair by pair, and the three forces on the blade stand at the place.
///
/// A pair remembers on which side of the triangle the axis was when it came over it, as long as
/// some of it stands over the triangle. An axis that is in a blade or beyond is pushed back to that
/// side, however many steps ago it went through; what slides on under the next triangle takes the
/// side along. What stands in a blade as drawn has no side and is let alone, and pairs that overlap
/// as drawn by more than the margin are left out. A plant's blades do not touch the plant itself.
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
  /// Forgets on which sides things were: a state was set from outside.
  void forget();

 private:
  struct Face {
    int plant = 0;
    BladeTriangle corners;  // by joined elements
    int leaf = 0;
    // Faces that hang together by edges have one number, and the sign that turns their normals to
    // one side. `inner`: 1 at each edge that another one has, too, else 0.
    int patch = 0, turn = 1;
    Vec3 inner = Vec3::Zero();
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

  // Where the axis of a pair belongs, by the normal of the face.
  struct Side {
    int sign = 0;             // of the normal; 0: unknown, or nothing of it stands over the face
    bool is_through = false;  // in the blade, or beyond
  };
  struct Standing {
    Side side;
    double depth = 0.0;            // m, beyond the face, of what stands over it
    Vec3 normal_W = Vec3::Zero();  // unit, of the face; zero: it is a sliver
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
  void join_faces(const Leaf& leaf);
  bool is_covered(const RodModel& model, const RodState& state) const;
  void rebuild(const RodModel& model, const RodState& state);
  void meet(const RodState& state, const Leaf& leaf, int plant);
  Box way_of(const RodState& state, const Face& face) const;
  Box way_of(const RodModel& model, const RodState& state, int shape) const;
  void keep_sides();
  void remember(const RodModel& model, const RodState& start);
  bool is_whole(const RodModel& model, const RodState& state, const Candidate& pair) const;
  int side_in_patch(const Candidate& pair) const;
  Standing standing(const RodModel& model, const RodState& from, const RodState& state,
                    std::size_t candidate) const;
  bool place(const Axis& was, const Corners& were, const Axis& axis, const Corners& now,
             double moved, const Candidate& pair, const Standing& standing, Touch& touch) const;
  void touch(const RodModel& model, const RodState& state, double dt, std::size_t candidate,
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
  std::vector<Side> sides_;                       // of the candidates, at the step's start
  bool any_through_ = false;
  RodState before_;  // poses at the start of the step before; empty: there is none
  std::vector<std::pair<Vec3, Vec3>> reference_;  // m, W, near and far ends, by element
  bool start_is_covered_ = false;                 // by the candidates
  // Scratch.
  std::vector<Box> shape_ways_, plant_ways_;
  std::vector<Candidate> old_candidates_;
  std::vector<Side> old_sides_;
};

}  // namespace pedicel::cosserat
