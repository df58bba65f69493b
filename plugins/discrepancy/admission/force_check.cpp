// Forces. Led slowly, a point pulls back like a spring: what holds it pushes the way it goes, about
// as hard as the nominal plant says. Only a plant that gains energy would pull the other way.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr double agrees = 0.5;  // of the force's motion
constexpr double mostly = 0.8;  // a cosine
// A modulus ten times off, and a gain of the sensor beside.
constexpr double most_off = 30.0;
constexpr double sure = 4.0;  // deviations
constexpr int least_rows = 10;
constexpr double least_compliance =
    1.0e-3;  // of the softest axis: a rod, its joints and the grip give

std::string likely_unit(double ratio) {
  // Grams for newtons are a factor of 102, millinewtons of 1000. They part at their geometric mean,
  // since the plant's own stiffness is known to a factor only.
  if (ratio > 50.0 && ratio < 320.0) return "; in grams?";
  if (ratio >= 320.0 && ratio < 3200.0) return "; in millinewtons?";
  if (ratio < 1e-2 && ratio > 1e-4) return "; in kilonewtons?";
  return "";
}

/// N/m, of a point that is led along an axis.
struct Range {
  double free = 0.0;  ///< it may go aside
  double held = 0.0;  ///< it is held along the other axes, too: a rod hardly stretches
};
Range stiffness(const Mat3& compliance, double grip, const Vec3& along) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(compliance);
  // Along a rod nothing gives in the model, and something does in every rod.
  const double least = least_compliance * axes.eigenvalues()[2];
  Range range{1.0 / (along.dot(compliance * along) + grip), 0.0};
  for (int i = 0; i < 3; ++i)
    // Springs side by side: held along all axes, stiffnesses add up.
    range.held += std::pow(axes.eigenvectors().col(i).dot(along), 2) /
                  (std::max(axes.eigenvalues()[i], least) + grip);
  return range;
}

// A plant that is led pulls back within the plane of the path and of its own stiffest axis, fast or
// slowly: not across both.
bool is_across(const Following& f, const Mat3& compliance) {
  // A force that does not follow the path at all has no direction to be wrong in.
  if (f.explained() < agrees) return false;
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(compliance);
  const Vec3 normal = f.along.cross(axes.eigenvectors().col(0));
  if (normal.norm() < 0.5) return false;  // led along that axis
  return std::abs(f.gain.dot(normal.normalized())) > mostly * f.gain.norm();
}

}  // namespace

std::optional<Fault> check_force(const TrialView& view) {
  const Trial& trial = view.trial;
  // The force is that of the first hold. A point that slides is pushed by friction and contact, of
  // which stiffness says nothing.
  if (!view.nominal_plant || trial.force.size() == 0 || trial.holds.empty() ||
      trial.holds.front().slides())
    return std::nullopt;
  const std::vector<Drive> drives = drives_of(view);
  if (drives.empty() || drives.front().kind != Drive::Kind::hold) return std::nullopt;
  const Drive& drive = drives.front();
  const Following f = following(force_track(trial), drive);
  // A hold that stays where it is changes no force that could be judged; its level may be an
  // offset.
  if (f.rows < least_rows || f.driven <= 0.0) return std::nullopt;
  const Mat3 plant = view.nominal_plant->compliance(drive.spot);
  if (!plant.allFinite()) return std::nullopt;
  if (is_across(f, plant))
    return Fault{"force.csv", "goes across the way that " + drive.path->file.string() +
                                  " leads the held point: expected the plant's pull against it; "
                                  "another axis, or another trial's table?"};
  // Led fast, a force is mass and damping, of which this plant's stiffness says nothing.
  if (!is_led_slowly(view, drive)) return std::nullopt;
  // The path is the hand's and not the point's: a soft grip takes a part of the way.
  const double grip = trial.holds.front().stiffness ? 1.0 / *trial.holds.front().stiffness : 0.0;
  const Range expected = stiffness(plant, grip, f.along);
  // A change for a change, so that a sensor that was not zeroed, a known effect, is not told here.
  const double measured = f.gain.dot(f.along);
  // What the path leaves of the force, as an error of its slope.
  const double error = sure * f.left / (f.driven * std::sqrt(static_cast<double>(f.rows)));
  const std::string said = text(
      "changes by %.3g N for a metre that the held point is led, and the nominal plant takes "
      "%.3g N: expected ",
      measured, expected.free);
  // Of the other sign clear of its error, along with the path, and no less than a thirtieth of what
  // is expected: a sensor's drift alone is none of these.
  if (measured < -error && f.explained() > agrees && -measured > expected.free / most_off)
    return Fault{"force.csv", said + "the holder's pull on the plant; of the opposite sign?"};
  // Against the stiffer of the two: a hold that lets nothing go aside is no mistake.
  const bool is_large = measured - error > most_off * expected.held && f.explained() > agrees;
  // Against the softer one, for the same reason the other way round.
  const bool is_small = std::abs(measured) + error < expected.free / most_off;
  if (!is_large && !is_small) return std::nullopt;
  return Fault{"force.csv", said + "newtons" +
                                likely_unit(measured / (is_large ? expected.held : expected.free))};
}

}  // namespace pedicel::discrepancy
