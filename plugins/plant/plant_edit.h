#pragma once

#include <functional>
#include <string>

#include "engine/geometry/curve.h"
#include "plugins/plant/plant_file.h"

/// Changes of a plant as it is drawn. Points count from 0, places on a curve are fractions of its
/// drawn length from its first point, everything is in the plant's frame P. What is impossible (a
/// name that is taken, a point that is not there) is a UsageError that says what was expected, and
/// then the plant is as it was.
///
/// What hangs on a stem goes where the stem goes: branches keep the place on their parent that
/// their foot has, fruits and leaves their fraction of the length.
namespace pedicel::plant {

/// Index of a curve; throws UsageError with the names there are.
int find_stem(const PlantFile& plant, const std::string& name);
/// The curve as it is interpolated.
geometry::Curve stem_curve(const PlantFile& plant, const std::string& name);
/// `wanted` where it is free among curves, fruits and leaves, else wanted_2, wanted_3, ...
std::string free_name(const PlantFile& plant, const std::string& wanted);

/// Throws where the curve has fewer than two points, equal neighbours, or radii that are not
/// positive or do not fit the points.
void add_stem(PlantFile& plant, PlantCurve curve);
/// Takes a stem off with everything that is on it, and its branches where they are to go, too.
void remove_stem(PlantFile& plant, const std::string& name, bool with_branches = true);
/// Cuts a stem at a place: what lies beyond, seen from its foot, goes with everything on it, and
/// the branches that hang there. What is on the rest stays where it was drawn. Throws where less
/// than a millimetre would be left, or taken.
void trim_stem(PlantFile& plant, const std::string& stem, double at);
/// Of a curve, fruit or leaf; what is on a curve goes with its name.
void rename(PlantFile& plant, const std::string& name, const std::string& new_name);

/// A corner keeps the points that hold it (point_kind.h).
void move_point(PlantFile& plant, const std::string& stem, int point, const Vec3& to);
/// On the curve as it is now, with the radius that it has there. Returns its index.
int insert_point(PlantFile& plant, const std::string& stem, double at);
/// With those that hold it.
void remove_point(PlantFile& plant, const std::string& stem, int point);
/// All points at once; a list of radii is resampled where the number of points is another.
void set_points(PlantFile& plant, const std::string& stem, const std::vector<Vec3>& points);
/// Moves the inner points from `first` to `last` by a share (0 to 1) of the way to the middle of
/// their neighbours, all at once (Laplacian smoothing).
void smooth_points(PlantFile& plant, const std::string& stem, double share, int first, int last);
void move_stem(PlantFile& plant, const std::string& stem, const Vec3& by);
/// Scales a stem about its foot until it is that long (m); its radii stay.
void set_length(PlantFile& plant, const std::string& stem, double length);

/// m, at one point; the others keep theirs. `point` -1: everywhere.
void set_radius(PlantFile& plant, const std::string& stem, int point, double radius);
/// Linear in arc length from the stem's foot to its tip (m).
void taper(PlantFile& plant, const std::string& stem, double from, double to);
void set_interpolation(PlantFile& plant, const std::string& stem, Interpolation interpolation);

/// A copy with what is on it and its branches, mirrored at the plane through its foot (the place on
/// the parent, if it has one) with that normal; a zero normal takes the stem's own direction across
/// the parent, so that the copy is on the other side. Returns the copy's name.
std::string mirror_stem(PlantFile& plant, const std::string& stem, const std::string& name,
                        const Vec3& normal = Vec3::Zero());
/// So many copies up the parent, each `spacing` (m along it) further and turned `angle` (rad)
/// further about it. Throws where that leaves the parent.
void repeat_stem(PlantFile& plant, const std::string& stem, int count, double spacing,
                 double angle);

}  // namespace pedicel::plant
