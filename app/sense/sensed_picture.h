#pragma once

#include "app/draw/scene_view.h"
#include "app/sense/keypoints.h"

namespace pedicel::app {

/// What a camera of a simulation sees: colours, labels, depths and keypoints.
struct SensedPicture {
  double time = 0.0;  ///< s, of what is seen
  CameraMatrices camera;
  render::Image image;  ///< empty where no colours were asked for
  render::LabelMap map;
  std::vector<Keypoint> keypoints;
};

/// Labels as they are. Throws UsageError where there are more than 65535.
render::GrayImage instance_mask(const render::LabelMap& map);
/// ThingClass of each pixel.
render::GrayImage class_mask(const render::LabelMap& map, const NamedThings& things);
/// Millimetres, rounded; 0 where nothing is, nothing was measured, or beyond 65.535 m.
render::GrayImage depth_millimetres(const std::vector<float>& depth, int width, int height);

}  // namespace pedicel::app
