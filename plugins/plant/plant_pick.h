#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plugins/plant/plant_file.h"

/// What a stroke that begins here would hang on.
namespace pedicel::plant {

/// A place on a stem as it is drawn, in the plant's frame P.
struct StemPlace {
  std::string stem;
  double at = 0.0;               ///< 1, fraction of its length
  Vec3 point = Vec3::Zero();     ///< m, on the centre line
  Vec3 tangent = Vec3::UnitZ();  ///< unit, towards the last point
  double radius = 0.0;           ///< m, there
  double distance = 0.0;         ///< m, of what was asked for from the stem's surface, >= 0
  double depth = 0.0;            ///< m, along the ray
};

/// Finds places on the stems of a plant as it was when this was made.
class StemPicker {
 public:
  explicit StemPicker(const PlantFile& plant);

  /// The nearest place whose surface is within `reach` (m) of a point.
  std::optional<StemPlace> near_point(const Vec3& point, double reach) const;
  /// The nearest place that a ray (unit direction) passes within the reach of: `reach` (m) plus
  /// `widening` (1) times the depth, so that some pixels are some pixels at any distance. Stems in
  /// front win over those behind where the ray meets both.
  std::optional<StemPlace> under_ray(const Vec3& origin, const Vec3& direction, double reach,
                                     double widening) const;

 private:
  struct Chord {
    int stem;
    double arc_near, arc_far, radius_near, radius_far;  // m
    Vec3 near, far;                                     // m
  };
  StemPlace place(const Chord& chord, double share) const;

  std::vector<std::string> names_;
  std::vector<double> lengths_;  // m
  std::vector<Chord> chords_;
};

}  // namespace pedicel::plant
