#pragma once

#include <string_view>
#include <vector>

#include "app/draw/named_things.h"
#include "app/sense/camera_matrices.h"
#include "engine/render/label_map.h"

namespace pedicel::app {

/// A place on an organ that pictures are labelled with.
struct Keypoint {
  /// Of a fruit its centre and where its stalk breaks (off the plant: where it broke); of stems,
  /// branches and stalks their foot and their tip.
  enum class Kind { centre, attachment, foot, tip };
  /// As COCO means it: outside of the picture; hidden; seen.
  enum class Visibility { outside = 0, hidden = 1, seen = 2 };

  render::Label thing = 0;
  Kind kind = Kind::centre;
  Vec3 position = Vec3::Zero();  ///< m, W
  double radius = 0.0;           ///< m, of the organ there
  double u = 0.0, v = 0.0;       ///< px, in the picture that look_at() was given
  double depth = 0.0;            ///< m, along the view axis
  Visibility visibility = Visibility::outside;
};
std::string_view name_of(Keypoint::Kind kind);

/// The keypoints of every organ that is there, in the order of their labels. What went off with a
/// fruit goes on with it; a leaf has none.
std::vector<Keypoint> keypoints_of(const simulation::Simulation& simulation,
                                   const NamedThings& things);

/// A keypoint lies inside its organ. It is seen where nothing is nearer than the organ's surface:
/// the picture's depth there is at least its own less 1.1 times the radius less this.
inline constexpr double keypoint_slack = 0.002;  // m
void look_at(std::vector<Keypoint>& keypoints, const CameraMatrices& camera,
             const render::LabelMap& map);

}  // namespace pedicel::app
