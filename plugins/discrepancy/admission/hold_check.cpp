// Paths of held points. They are told in the plant's frame and begin where the plant is: where its
// drawing has the point, displaced as the markers beside it are.
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/axes.h"
#include "plugins/discrepancy/admission/first_places.h"
#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// A spring between path and point gives way by no more than the plant is led aside, a tenth of its
// reach in most trials.
constexpr double spring_share = 0.05;  // of the reach; beside largest_known::offset
constexpr double much_nearer = 0.25;
constexpr double beside = 0.3;  // of the way from the root, as for what follows a drive
constexpr double turned_far = 1.5, turned_little = 0.5;  // rad

std::string point(const Vec3& x) {
  return text("(%.3g, %.3g, ", x.x(), x.y()) + text("%.3g) m", x.z());
}

/// Where the held point should begin.
Vec3 expected_place(const TrialView& view, const Spot& spot) {
  const FirstPlaces places = first_places(view);
  const int marker = marker_near(*view.nominal_plant, spot, beside);
  for (int i = 0; i < places.size(); ++i)
    // Beyond what a turned or scaled frame makes of it, markers are aside because the plant is. The
    // marker beside it says how far the plant was aside when the trial began: it may have been led
    // there before.
    if (places.marker[i] == marker) {
      const Vec3 aside = places.seen[i] - places.settled[i];
      const double frame = (largest_known::rotation + largest_known::scale) * places.seen[i].norm();
      return spot.settled + (aside.norm() > frame ? aside : Vec3::Zero());
    }
  return spot.settled;
}

// How much farther than it may be the path begins from where it should.
class Beginning {
 public:
  Beginning(const TrialView& view, const Spot& spot)
      : expected_(expected_place(view, spot)),
        settled_(spot.settled),
        limit_(largest_known::offset + spring_share * view.nominal_plant->reach()) {}

  double distance(const Vec3& begins) const {
    // Either is right: the marker may be the one that is off, and the path not.
    return std::min((begins - expected_).norm(), (begins - settled_).norm());
  }
  // A marker may sit 0.05 m aside and a soft spring give a part of the way: within that the path
  // may well be right.
  bool is_far(const Vec3& begins) const { return distance(begins) > limit_; }
  const Vec3& expected() const { return expected_; }

 private:
  Vec3 expected_, settled_;
  double limit_;
};

std::string likely(const TrialView& view, const Hold& hold, const Beginning& beginning) {
  const Vec3 begins = hold.path.position.front();
  // A guess must bring the path to a quarter of its distance: one that only improves it explains
  // nothing.
  const double far = beginning.distance(begins);
  // Scales first, then axes, then another point: from the mistake that explains most to the one
  // that fits by chance.
  for (const auto& [scale, name] : {std::pair(1e3, "millimetres"), std::pair(1e2, "centimetres"),
                                    std::pair(1.0 / 0.0254, "inches")})
    if (beginning.distance(begins / scale) < much_nearer * far && !beginning.is_far(begins / scale))
      return std::string("; in ") + name + "?";
  const Axes* best = nullptr;
  double least = much_nearer * far;
  for (const Axes& axes : other_axes()) {
    const double there = beginning.distance(axes.read * begins);
    // A rarer reading has to fit clearly better than a commoner one.
    if (there >= (best ? 0.9 * least : least)) continue;
    least = there;
    best = &axes;
  }
  if (best) return "; read as " + as_read(best->read) + " it would: " + best->what + "?";
  double nearest = much_nearer * far, at = -1.0;
  // Along its own curve, a twentieth at a time: near enough to name the place in a sentence.
  for (int i = 0; i <= 20; ++i) {
    const Spot other = view.nominal_plant->spot({hold.place.curve, 0.05 * i, {}});
    // The nearest of them, as its neighbours are nearly as near.
    if ((other.settled - begins).norm() >= nearest) continue;
    nearest = (other.settled - begins).norm();
    at = 0.05 * i;
  }
  if (at >= 0.0) return text("; the path of the point at %.2g of ", at) + hold.place.curve + "?";
  return "; another frame, or another point's path?";
}

std::optional<Fault> begins_elsewhere(const TrialView& view, const Hold& hold) {
  const Spot spot = view.nominal_plant->spot(hold.place);
  const Beginning beginning(view, spot);
  const Vec3 begins = hold.path.position.front();
  if (!beginning.is_far(begins)) return std::nullopt;
  return Fault{hold.path.file, "begins at " + point(begins) + ", and what it holds is at " +
                                   point(beginning.expected()) + text(" (%.3g of ", hold.place.at) +
                                   hold.place.curve + "): expected the held point's own path" +
                                   likely(view, hold, beginning)};
}

double angle(const Quat& q) {
  return Eigen::AngleAxisd(q.normalized()).angle();
}

// Rotations are by how much the point has turned since the plant was drawn: little, at first.
std::optional<Fault> turned_quaternion(const DrivenPath& path) {
  if (path.rotation.empty()) return std::nullopt;
  const Quat& first = path.rotation.front();
  // Read as qw, qx, qy, qz.
  const Quat other(first.x(), first.y(), first.z(), first.w());
  // Both: a plant may be turned by as much before the record begins, but then the other reading is
  // no small turn.
  if (angle(first) < turned_far || angle(other) > turned_little) return std::nullopt;
  return Fault{path.file, text("begins with a turn of %.3g rad, read as qw, qx, qy, qz one of "
                               "%.2g rad: expected qx, qy, qz, qw",
                               angle(first), angle(other))};
}

}  // namespace

std::optional<Fault> check_holds(const TrialView& view) {
  if (!view.nominal_plant) return std::nullopt;
  for (const Hold& hold : view.trial.holds) {
    // A hold without a path holds the point where it is.
    if (hold.path.time.empty()) continue;
    if (hold.slides()) continue;  // it may begin beside its path
    // First, because a mistake of the order of four columns has one reason only.
    if (auto fault = turned_quaternion(hold.path)) return fault;
    if (auto fault = begins_elsewhere(view, hold)) return fault;
  }
  // A base may begin anywhere: it carries the plant along, and nothing says where it should be.
  if (view.trial.base) return turned_quaternion(*view.trial.base);
  return std::nullopt;
}

}  // namespace pedicel::discrepancy
