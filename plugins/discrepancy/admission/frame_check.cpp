// Frames. At time 0 the plant stands as its drawing has it, but for its sag, for what holds and
// loads do to it, and for a frame that is turned by 0.3 rad and off by 0.2 in scale about the
// world's origin.
#include <Eigen/SVD>
#include <cmath>

#include "plugins/discrepancy/admission/axes.h"
#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// Of the markers' rms distance from the root. What holds, loads and a softer plant do is less, or
// does not fit other axes four times as well by chance: three numbers of every marker would have
// to.
constexpr double least_misfit = 0.1, by_chance = 0.25;
// Turned about the vertical, beyond what a frame may be: nothing turns a plant that way. At least
// four markers, whose places are not on the vertical through what the frame turns about.
constexpr double least_turn = 0.45;  // rad
constexpr int turned_markers = 4;
constexpr double off_axis = 0.1;  // of the reach, rms
// All markers are aside by nearly the same. A clamped rod's are not, whatever bends it: those near
// the root stay.
constexpr double uniform = 0.3, near_root = 0.5;
constexpr double least_shift = 0.08;  // of the reach, and largest_known::offset
// Whatever the reason: as far from the drawing as the plant is large.
constexpr double elsewhere = 1.0;

std::string millimetres(double metres) {
  return text("%.3g mm", 1e3 * metres);
}

std::vector<Vec3> read_as(const Mat3& axes, const std::vector<Vec3>& seen) {
  std::vector<Vec3> read;
  for (const Vec3& x : seen) read.push_back(axes * x);
  return read;
}

// m, rms from the drawing or from how the plant settles, whichever is nearer.
double misfit(const FirstPlaces& places, const std::vector<Vec3>& seen) {
  // A plant may have been drawn as it hangs, or as it grew.
  return std::min(rms_distance(seen, places.drawn), rms_distance(seen, places.settled));
}

// What a small turn and a scale about the world's origin leave of the misfit to `places`
// (Kabsch 1976, Umeyama 1991); of a turn that is too large, all of it.
double unexplained(const std::vector<Vec3>& places, const std::vector<Vec3>& seen) {
  Mat3 sum = Mat3::Zero();
  double square = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    sum += seen[i] * places[i].transpose();
    square += places[i].squaredNorm();
  }
  // About the origin and not about the means: a frame is set up about its own origin, and a shift
  // is no effect that is known.
  const Eigen::JacobiSVD<Mat3> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 sign = Vec3::Ones();
  // A mirrored frame fits a flat plant as well, and no camera makes one: only turns count.
  sign.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  const Mat3 turn = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  const double scale = svd.singularValues().dot(sign) / std::max(square, 1e-30);
  const bool is_known = Eigen::AngleAxisd(turn).angle() <= largest_known::rotation &&
                        std::abs(scale - 1.0) <= largest_known::scale;
  // A turn and a scale that the diagnosis can find are left to it.
  return is_known ? rms_distance(seen, read_as(scale * turn, places)) : rms_distance(seen, places);
}

std::optional<Fault> other_axes_fit(const FirstPlaces& places, double left) {
  // Only what is clearly off the drawing is asked why.
  if (left < least_misfit * places.spread()) return std::nullopt;
  const Axes* best = nullptr;
  // Four times as well, because 47 readings are tried, and a flat plant fits some of them by
  // itself.
  double least = by_chance * left;
  for (const Axes& axes : other_axes()) {
    const double there = misfit(places, read_as(axes.read, places.seen));
    // The commoner mistake, where the plant is too flat to tell.
    if (there >= (best ? 0.9 * least : least)) continue;
    least = there;
    best = &axes;
  }
  if (!best) return std::nullopt;
  return Fault{"markers.csv", "begins " + millimetres(misfit(places, places.seen)) +
                                  " from the plant's drawing, and " + millimetres(least) +
                                  " from it where its axes are read as " + as_read(best->read) +
                                  ": expected (x, y, z) of the plant's frame, z up; " + best->what +
                                  "?"};
}

// The turn about the vertical through `axis` that brings `seen` nearest to `places`.
double turn_to(const std::vector<Vec3>& places, const std::vector<Vec3>& seen, const Vec3& axis) {
  double cosine = 0.0, sine = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    // The plane problem of Kabsch has a closed form: the angle of the sum of products.
    const Vec3 a = seen[i] - axis, b = places[i] - axis;
    cosine += a.x() * b.x() + a.y() * b.y();
    sine += a.x() * b.y() - a.y() * b.x();
  }
  return std::atan2(sine, cosine);
}

std::optional<Fault> turned_about_vertical(const FirstPlaces& places, double left,
                                           const TrialView& view) {
  // Fewer markers fit some turn by chance.
  if (places.size() < turned_markers || left < least_misfit * places.spread()) return std::nullopt;
  // About the origin, where frames are set, or about the root, where pots are turned.
  for (const Vec3& axis : {Vec3(Vec3::Zero()), places.root}) {
    double square = 0.0;
    for (const Vec3& x : places.drawn) square += (x - axis).head<2>().squaredNorm();
    // What stands on the axis does not show a turn about it.
    if (std::sqrt(square / places.size()) < off_axis * view.nominal_plant->reach()) continue;
    const double angle = turn_to(places.settled, places.seen, axis);
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    std::vector<Vec3> back;
    for (const Vec3& x : places.seen) back.push_back(axis + turn * (x - axis));
    const double there = misfit(places, back);
    // More than a frame may be turned by, which is a finding, and then it must nearly fit.
    if (std::abs(angle) < least_turn || there > by_chance * left) continue;
    return Fault{"markers.csv",
                 "begins " + millimetres(misfit(places, places.seen)) +
                     " from the plant's drawing, and " + millimetres(there) +
                     text(" from it where it is turned by %.3g degrees about z: expected the "
                          "plant's own frame; a frame turned on the floor?",
                          angle * 180.0 / M_PI)};
  }
  return std::nullopt;
}

// A turn and a scale about an origin that is far away move all markers alike, too.
std::optional<Fault> shifted(const FirstPlaces& places, const TrialView& view) {
  double nearest = view.nominal_plant->reach(), farthest = 0.0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < places.size(); ++i) {
    const double from_root = view.nominal_plant->markers()[places.marker[i]].from_root;
    nearest = std::min(nearest, from_root);
    farthest = std::max(farthest, from_root);
    mean += (places.seen[i] - places.settled[i]) / places.size();
  }
  std::vector<Vec3> back = places.seen;
  // Put back by the mean: what is left then is no shift.
  for (Vec3& x : back) x -= mean;
  // Far from the origin a frame that is turned a little moves all markers by the same. So what a
  // known turn and scale make of the root's place is allowed for.
  const double limit = std::max(largest_known::offset, least_shift * view.nominal_plant->reach()) +
                       (largest_known::rotation + largest_known::scale) * places.root.norm();
  // Without a marker near the root a bend looks like a shift.
  if (nearest > near_root * farthest || mean.norm() < limit) return std::nullopt;
  // Moved back they must fit: what is aside by different ways was bent.
  if (misfit(places, back) > uniform * mean.norm()) return std::nullopt;
  return Fault{"markers.csv", "has all markers aside of the plant's drawing by about (" +
                                  text("%.3g, %.3g, ", mean.x(), mean.y()) +
                                  text("%.3g) m", mean.z()) +
                                  ": expected the plant's own frame, its root at (" +
                                  text("%.3g, %.3g, ", places.root.x(), places.root.y()) +
                                  text("%.3g); the frame's origin elsewhere?", places.root.z())};
}

}  // namespace

std::optional<Fault> check_frame(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  const FirstPlaces places = first_places(view);
  if (places.size() == 0) return std::nullopt;
  // As drawn or as settled, whichever leaves less, in favour of the data.
  const double left =
      std::min(unexplained(places.drawn, places.seen), unexplained(places.settled, places.seen));
  // From what names a mistake to what only says that there is one: exchanged axes would also be a
  // turn, and both a shift.
  if (auto fault = other_axes_fit(places, left)) return fault;
  if (auto fault = turned_about_vertical(places, left, view)) return fault;
  if (auto fault = shifted(places, view)) return fault;
  if (left < elsewhere * view.nominal_plant->reach()) return std::nullopt;
  return Fault{"markers.csv",
               "begins " + millimetres(left) + " from the plant's drawing, and the plant reaches " +
                   millimetres(view.nominal_plant->reach()) + ": expected the plant's own frame"};
}

}  // namespace pedicel::discrepancy
