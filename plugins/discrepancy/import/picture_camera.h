#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "engine/core/diagnostics.h"
#include "engine/core/frames.h"

namespace pedicel::discrepancy {

/// A pinhole camera with Brown's distortion. Its frame: x right, y down, z forward.
struct PictureCamera {
  Pose pose;                           ///< of the camera in the world
  Eigen::Vector2d focal, centre;       ///< pixels
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3, 1

  /// Unit vector in the world along which a pixel (x right, y down) looks. Nothing where the
  /// distortion cannot be undone there.
  std::optional<Vec3> ray(const Eigen::Vector2d& pixel) const;
};

/// Reads a map {position, orientation, focal, centre, size, distortion} from YAML or JSON. Faults
/// go to the diagnostics; nothing comes back then.
std::optional<PictureCamera> read_picture_camera(const std::filesystem::path& file,
                                                 Diagnostics& diagnostics);

/// A plane of the world across one of its axes, in which the points of a picture move.
struct PicturePlane {
  int axis = 1;         ///< 0, 1, 2
  double offset = 0.0;  ///< m

  /// Where a ray from `eye` meets it in front of the eye; nothing where it does not.
  std::optional<Vec3> meets(const Vec3& eye, const Vec3& ray) const;
};

/// "y=0.02". Throws UsageError.
PicturePlane plane_of_text(std::string_view text, const std::string& option);

}  // namespace pedicel::discrepancy
