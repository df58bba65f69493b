#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/ui/ui.h"
#include "engine/geometry/curve.h"
#include "plugins/plant/stroke_fit.h"

namespace pedicel::app {

/// A place on a stem of the document.
struct StemHit {
  std::string plant, stem;
  double at = 0.0;              ///< 1, fraction of the stem's drawn length, from its first point
  double from_foot = 0.0;       ///< 1, the same from its foot, as the rods lie
  Vec3 drawn_W = Vec3::Zero();  ///< m, as it is drawn
  Vec3 now_W = Vec3::Zero();    ///< m, where it is in the simulation
};

/// The stem under the pointer as the document knows it; nothing where that is no stem of a plant
/// that can be edited.
std::optional<StemHit> stem_hit(const Ui& ui, const Selection& hit);

/// The drawn curve of a stem, in its plant's frame; nothing for an unknown one.
std::optional<geometry::Curve> drawn_curve(const Session& session, const std::string& plant,
                                           const std::string& stem);
/// A stroke (m, W) as the draw tool's options say: control points of a smooth curve within the
/// tolerance, and their radii. Nothing of a stroke without extent.
struct StemShape {
  std::vector<Vec3> points;    ///< m, W
  std::vector<double> radius;  ///< m
};
/// The samples' pressure is how many times as thick it is there as the options say.
std::optional<StemShape> shape_of(const std::vector<plant::StrokeSample>& stroke_W,
                                  const DrawMode& options);
/// Radii along control points: from `largest` at the foot to `smallest` at the tip, changing
/// between the fractions `start` and `end` of the length.
std::vector<double> taper_radii(const std::vector<Vec3>& points, double largest, double smallest,
                                double start, double end);

/// A fruit or leaf of the document.
struct OrganPlace {
  std::string plant, name;
  plant::CurvePlace place;
  bool is_leaf = false;
};
/// The fruit or leaf that a selection is of; nothing where it is of neither.
std::optional<OrganPlace> organ_of(const Ui& ui, const Selection& selection);

/// X_WP of a plant of the document; the identity for an unknown one.
Pose plant_pose(const Session& session, const std::string& plant);
/// The plant's file; null where there is none.
const plant::PlantFile* plant_file(const Session& session, const std::string& plant);

}  // namespace pedicel::app
