#pragma once

#include "app/sense/sensed_picture.h"
#include "engine/ros_messages/sensor_messages.h"

/// What a camera saw as messages. The header is the caller's.
namespace pedicel::app {

/// A pinhole without distortion ("plumb_bob" of zeros).
ros::CameraInfo camera_info_of(const CameraMatrices& camera);

/// "rgb8".
ros::Image image_of(const render::Image& image);
/// "32FC1": m along the view axis; +inf where nothing is, nan where it was lost (REP 118).
ros::Image depth_image_of(const render::LabelMap& map);
/// "16UC1": labels.
ros::Image mask_of(const render::GrayImage& mask);

/// The points that a depth camera sees, in the camera's frame, one a pixel, nan where there is
/// none: fields x, y, z (m) and, where there are colours, rgb.
ros::PointCloud2 points_of(const SensedPicture& picture);

}  // namespace pedicel::app
