#include <cmath>
#include <numbers>
#include <optional>

#include "plugins/discrepancy/test/symptom_parts.h"

namespace pedicel::discrepancy {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

// v x as a matrix.
Eigen::Matrix3d cross(const Vec3& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

bool seen(const StaticStretch& stretch, int marker) {
  return stretch.mean.segment<3>(3 * marker).allFinite();
}

Vec3 root_of(const SymptomContext& context, const StaticStretch& stretch) {
  const Trial& trial = context.trial(stretch.trial);
  const Vec3& root = context.experiment.plant().root;
  // On a shaker the root goes along with its base.
  if (!trial.base) return root;
  const double t = trial.markers.time[stretch.from];
  return root + trial.base->position_at(t) - trial.base->position_at(0.0);
}

/// A rotation vector with its covariance, from mean residuals about a point.
struct Turn {
  Vec3 angle = Vec3::Zero();  // rad
  Measured size;
  double explained = 0.0;
};

// Small turn about the root: residual = angle x arm, least squares weighted with the errors.
// By the stretches' means, whose errors differ by marker: one that was seen for a moment must not
// turn the plant.
std::optional<Turn> base_turn(const StaticStretch& stretch, const Vec3& root) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  double squares = 0.0;
  int count = 0;
  for (int m = 0; m < stretch.mean.size() / 3; ++m) {
    if (!seen(stretch, m)) continue;
    // Both sides over the errors: the least squares of what is left then have unit weights.
    const Vec3 weight = stretch.error.segment<3>(3 * m).cwiseInverse();
    // angle x arm = -arm x angle, so the matrix of the unknown has the minus sign.
    const Eigen::Matrix3d x =
        -(weight.asDiagonal() * cross(stretch.position.segment<3>(3 * m) - root));
    const Vec3 r = weight.cwiseProduct(stretch.mean.segment<3>(3 * m));
    information += x.transpose() * x;
    right += x.transpose() * r;
    squares += r.squaredNorm();
    ++count;
  }
  // Three coordinates of one marker have any turn explain them.
  if (count < 2) return std::nullopt;
  // Markers in line with the root do not see a turn about that line: minimum length there.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  const double most = eigen.eigenvalues()[2];
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  // What is left open gets zero and not a large number with a large error: the length of the turn
  // is told, and it must not be one of noise.
  for (int i = 0; i < 3; ++i)
    if (eigen.eigenvalues()[i] > 1.0e-2 * most)
      covariance += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() /
                    eigen.eigenvalues()[i];
  Turn turn;
  turn.angle = covariance * right;
  turn.size.value = turn.angle.norm();
  // No turn has no direction, and no error along it.
  if (turn.size.value == 0.0) return std::nullopt;
  const Vec3 along = turn.angle / turn.size.value;
  turn.size.error = std::sqrt(along.dot(covariance * along));
  // A turn about the root explains all of what a soft root makes, and a part of what any bend
  // makes. So the share is told, too.
  turn.explained = squares > 0.0 ? turn.angle.dot(right) / squares : 0.0;
  return turn;
}

SymptomPlot turn_plot(const StaticStretch& stretch, const Vec3& root, const Turn& turn,
                      const std::string& name) {
  SymptomPlot plot{"Residual at rest against the distance from the root (" + name + ")",
                   "distance from the root (m)",
                   "residual along the turn (mm)",
                   {{"measured less simulated", {}, {}, false}, {"a rigid turn", {0.0}, {0.0}}}};
  double far = 0.0, sum = 0.0, weight = 0.0;
  for (int m = 0; m < stretch.mean.size() / 3; ++m) {
    if (!seen(stretch, m)) continue;
    const Vec3 arm = stretch.position.segment<3>(3 * m) - root;
    // Each marker against what the turn would do to it. A rigid turn makes a line through the
    // origin, a bend a curve.
    const Vec3 would = turn.angle.cross(arm);
    // A marker on the axis says nothing of it.
    if (would.norm() == 0.0) continue;
    plot.series[0].x.push_back(arm.norm());
    plot.series[0].y.push_back(1e3 * stretch.mean.segment<3>(3 * m).dot(would.normalized()));
    far = std::max(far, arm.norm());
    sum += 1e3 * would.norm() * arm.norm();
    weight += arm.squaredNorm();
  }
  // The line is a rigid turn of this size by least squares: markers beside the plane of the turn
  // have a shorter arm.
  plot.series[1].x.push_back(far);
  plot.series[1].y.push_back(weight > 0.0 ? far * sum / weight : 0.0);
  return plot;
}

void add_base_rotation(const SymptomContext& context, const std::vector<StaticStretch>& stretches,
                       std::vector<Symptom>& out) {
  for (const StaticStretch& stretch : stretches) {
    const Vec3 root = root_of(context, stretch);
    const std::optional<Turn> turn = base_turn(stretch, root);
    if (!turn) continue;
    const std::string name = stretch_name(context, stretch);
    Symptom symptom =
        make_symptom("base_rotation", name, degrees * turn->size.value, degrees * turn->size.error);
    symptom.unit = "deg";
    symptom.sentence = "At rest (" + name + ") the plant stands turned about its root by " +
                       with_error(symptom.value, symptom.standard_error, "degrees") +
                       " from where the model has it; a rigid turn explains " +
                       short_number(100.0 * turn->explained) + " % of the residual there.";
    symptom.plot = turn_plot(stretch, root, *turn, name);
    out.push_back(std::move(symptom));
  }
}

/// A point of a chain at rest: its residual, error and distance along the chain.
struct ChainPoint {
  std::string name;
  double arc = 0.0;
  Vec3 residual = Vec3::Zero(), error = Vec3::Zero(), position = Vec3::Zero();
};

// The clamped root stays where it is, so it is a point without residual.
// It stands for a marker that is never wrong, and lets a bend between the root and the first marker
// be seen.
std::vector<ChainPoint> points_of(const SymptomContext& context, const MarkerChain& chain,
                                  const StaticStretch& stretch) {
  std::vector<ChainPoint> points;
  // A branch's own foot moves with what carries it, and is no such point.
  if (chain.rooted)
    points.push_back({"the root", 0.0, Vec3::Zero(), Vec3::Zero(), root_of(context, stretch)});
  for (std::size_t i = 0; i < chain.markers.size(); ++i) {
    const int m = chain.markers[i];
    // Two markers at one place have no chord between them.
    if (!seen(stretch, m) || (!points.empty() && chain.arc[i] - points.back().arc < 1e-6)) continue;
    // Without a marker that was hidden: its neighbours then stand for one longer stretch.
    points.push_back({context.experiment.markers[m].name, chain.arc[i],
                      stretch.mean.segment<3>(3 * m), stretch.error.segment<3>(3 * m),
                      stretch.position.segment<3>(3 * m)});
  }
  return points;
}

void add_curvature(const SymptomContext& context, const MarkerChain& chain,
                   const StaticStretch& stretch, std::vector<Symptom>& out) {
  const std::vector<ChainPoint> p = points_of(context, chain, stretch);
  const std::string& curve = context.experiment.plant().curves[chain.curve].name;
  // Of residuals and not of places: the curvature of the plant itself drops out, and what is left
  // is where it bends otherwise than the model. A shift vanishes in it, and on a straight chain a
  // turn does, too.
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const double before = p[i].arc - p[i - 1].arc, behind = p[i + 1].arc - p[i].arc;
    // Second difference over uneven distances.
    // Markers are put on by hand, and never at even distances.
    const double scale = 2.0 / (before + behind);
    const double a = scale / before, c = scale / behind, b = -(a + c);
    const Vec3 bend = a * p[i - 1].residual + b * p[i].residual + c * p[i + 1].residual;
    // Errors of different markers are independent.
    const Vec3 error = ((a * p[i - 1].error).cwiseAbs2() + (b * p[i].error).cwiseAbs2() +
                        (c * p[i + 1].error).cwiseAbs2())
                           .cwiseSqrt();
    // The length alone: the sentence says where the stem bends too much, which is what a reader
    // looks at.
    const Measured size = length_of(bend, error);
    const std::string name = stretch_name(context, stretch);
    Symptom symptom = make_symptom(
        "excess_curvature", curve + " at " + p[i].name + " (" + name + ")", size.value, size.error);
    symptom.unit = "1/m";
    symptom.sentence = "At rest (" + name + ") " + curve + " is bent by " +
                       with_error(size.value, size.error, "1/m") +
                       " otherwise than in the model around " + p[i].name + ", between " +
                       p[i - 1].name + " and " + p[i + 1].name + ".";
    out.push_back(std::move(symptom));
  }
}

// How a stretch between two points has turned, as far as two points tell: the smallest rotation.
// Two points do not tell a turn about their own line. The smallest one has none.
struct Rotation {
  Vec3 angle, error, along;
};
Rotation rotation_of(const ChainPoint& a, const ChainPoint& b) {
  const Vec3 arm = b.position - a.position;
  const Vec3 error = (a.error.cwiseAbs2() + b.error.cwiseAbs2()).cwiseSqrt();
  // The largest of the three for all: an error of the angle is one of a place across the arm,
  // whichever way that is.
  return {arm.cross(b.residual - a.residual) / arm.squaredNorm(),
          Vec3::Constant(error.maxCoeff() / arm.norm()), arm.normalized()};
}

void add_kink(const SymptomContext& context, const MarkerChain& chain, const StaticStretch& stretch,
              std::vector<Symptom>& out) {
  if (chain.parent < 0) return;
  const std::vector<ChainPoint> branch = points_of(context, chain, stretch);
  const std::vector<ChainPoint> parent = points_of(context, context.chains[chain.parent], stretch);
  // A direction takes two points on either side.
  if (branch.size() < 2 || parent.size() < 2) return;
  std::size_t i = 0;
  // The stretch of the parent that the junction is on.
  while (i + 2 < parent.size() && parent[i + 1].arc < chain.parent_arc) ++i;
  const Rotation carrier = rotation_of(parent[i], parent[i + 1]);
  const Rotation carried = rotation_of(branch[0], branch[1]);
  // A turn about either stretch's own line is not seen: the part across both counts.
  // How the branch has turned less how what carries it has: a junction that gives, whatever the
  // stem does.
  Vec3 kink = carried.angle - carrier.angle;
  const Vec3 across = carried.along.cross(carrier.along);
  if (across.norm() > 0.1) {
    // Only about the line across both stretches do both know their turn. Where they are parallel
    // every line across either is.
    kink = across.normalized() * kink.dot(across.normalized());
  } else {
    kink -= carried.along * kink.dot(carried.along);
  }
  const Vec3 error = (carrier.error.cwiseAbs2() + carried.error.cwiseAbs2()).cwiseSqrt();
  const Measured size = length_of(kink, error);
  const std::string& name = context.experiment.plant().curves[chain.curve].name;
  const std::string where = stretch_name(context, stretch);
  Symptom symptom = make_symptom("junction_kink", name + " (" + where + ")", degrees * size.value,
                                 degrees * size.error);
  symptom.unit = "deg";
  symptom.sentence = "At rest (" + where + ") " + name +
                     " stands at another angle to what carries "
                     "it than in the model, by " +
                     with_error(symptom.value, symptom.standard_error, "degrees") + ".";
  out.push_back(std::move(symptom));
}

}  // namespace

void add_static_symptoms(const SymptomContext& context, std::vector<Symptom>& out) {
  const std::vector<StaticStretch> stretches = static_stretches(context);
  add_base_rotation(context, stretches, out);
  // All stretches and all places. Which of them is the clearest is for the reader of the list.
  for (const StaticStretch& stretch : stretches)
    for (const MarkerChain& chain : context.chains) {
      add_curvature(context, chain, stretch, out);
      add_kink(context, chain, stretch, out);
    }
}

}  // namespace pedicel::discrepancy
