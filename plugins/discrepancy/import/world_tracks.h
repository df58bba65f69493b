#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/frames.h"
#include "plugins/discrepancy/import/picture_camera.h"
#include "plugins/discrepancy/import/recording.h"

namespace pedicel::discrepancy {

/// What the person who imports says of a recording, beside or in place of its file.
struct Statements {
  std::optional<double> unit;   ///< m, length of the file's unit (--units)
  std::optional<double> rate;   ///< Hz (--rate)
  std::optional<Mat3> axes;     ///< from the file's axes to the world's (--axes, --up)
  Vec3 origin = Vec3::Zero();   ///< m, W, of the file's origin (--origin)
  std::optional<double> scale;  ///< m a pixel (--scale)
  std::optional<Eigen::Vector2d> origin_pixel;  ///< x right, y down (--origin-pixel)
  std::optional<PictureCamera> camera;          ///< (--camera)
  std::optional<PicturePlane> plane;            ///< (--plane)
};

/// Points over time in the world.
struct WorldTracks {
  std::vector<double> time;  ///< s, on the recording's clock
  Eigen::MatrixXd value;     ///< m, W; samples x 3 points, NaN where not seen
};

/// What was found while data are brought together, as sentences.
struct ImportNotes {
  std::vector<std::string> missing;  ///< what nobody states: nothing can be imported then
  std::vector<std::string> said;     ///< what was taken, and from where
};

/// Brings a recording into the world: unit, axes and time as its file states, or as the person
/// does, whose word goes first. What neither states is put on notes.missing, with the option that
/// says it; what comes back then is of no use.
WorldTracks world_tracks(const Recording& recording, const Statements& statements,
                         ImportNotes& notes);

}  // namespace pedicel::discrepancy
