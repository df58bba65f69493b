#include "plugins/discrepancy/force/force_library.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "plugins/discrepancy/select/evidence.h"
#include "plugins/discrepancy/simulate/force_term.h"

namespace pedicel::discrepancy {

namespace {

// The pattern search goes on from the best of them, and 16 directions leave 11 degrees to it.
constexpr int headings = 16;   // directions across the curve that are tried
constexpr int thresholds = 8;  // of unilateral laws
constexpr int search_rounds = 6;
constexpr double slow = 0.01;  // m/s, below which friction sets in gradually

/// A number of a law that its force is not linear in, for the search.
// Of what a force is linear in, the best value follows at once and needs no search.
struct Knob {
  const char* name;
  int component;
  double step;  // first one; relative for `relative`
  bool relative;
};

class Library {
 public:
  Library(const ForceSpace& space, const ForcePath& path, const LibraryScales& scales)
      : space_(space), path_(path), scales_(scales) {
    // Where the place is at the start of the first trial: numbers of a law then stay of the plant's
    // size, wherever the world's origin is.
    about_ = path.position.front().row(0).transpose();
    // Along a stem nothing moves, and no force along it can be seen. A string may still lean.
    tangent_ = space.axes[0].cross(space.axes[1]);
  }

  std::vector<ForceTerm> run() {
    // The order does not matter: what comes first is sorted out by evidence, which counts the
    // numbers of each law.
    pushes();
    spring();
    unilateral("stop", {1.0});
    unilateral("string", {0.15, 0.4, 1.0});
    attraction();
    periodic();
    velocity();
    events();
    std::ranges::stable_sort(
        terms_, [](const ForceTerm& a, const ForceTerm& b) { return a.evidence > b.evidence; });
    return std::move(terms_);
  }

 private:
  // As an entry of a hypothesis, so that a refit begins with it without any translation.
  plant::Effect effect(const std::string& kind) const {
    plant::Effect force;
    force.name = missing_force;
    force.place = space_.place;
    force.words["kind"] = kind;
    return force;
  }

  // A positive multiple of the force, and what it gains.
  double single(const plant::Effect& force, double& factor) const {
    const Eigen::VectorXd c = history_of(force, space_, path_, scales_);
    // Gains follow from the normal equations: no law costs a simulation, so thousands can be tried.
    const double size = c.dot(space_.normal * c), right = c.dot(space_.right);
    // A string does not push and a drag does not drive, so a negative multiple is another law.
    factor = size > 0.0 ? std::max(0.0, right / size) : 0.0;
    // Of a parabola through no force: its top is half of slope times way.
    return 0.5 * factor * right;
  }

  // The best combination of forces that differ in their numbers alone.
  double several(const Eigen::MatrixXd& c, Eigen::VectorXd& factors) const {
    const Eigen::MatrixXd normal = c.transpose() * space_.normal * c;
    const Eigen::VectorXd right = c.transpose() * space_.right;
    // A place may not move along one of the two axes: then these have no unique solution, and the
    // smallest one is taken.
    factors = normal.completeOrthogonalDecomposition().solve(right);
    return factors.dot(right) - 0.5 * factors.dot(normal * factors);
  }

  void add(const plant::Effect& force, double gain, int parameters) {
    // The model around it is not perfect. What even a free force leaves is taken for noise, so that
    // gains are in units of what is left.
    ForceTerm term{force, gain / scales_.dispersion, parameters};
    // Many places and laws are tried, and the best of many is good by chance: the choice costs,
    // too.
    term.evidence = term.gain - cost_of(parameters, scales_.samples, scales_.choices);
    if (gain > 0.0) terms_.push_back(term);
  }

  // The simplest law: a weight that hangs there, or a wind that stays.
  void pushes() {
    plant::Effect force = effect("constant");
    Eigen::MatrixXd c(space_.size(), 2);
    for (int a = 0; a < 2; ++a) c.col(a) = push_history([](double, int) { return 1.0; }, a, -1);
    Eigen::VectorXd factors;
    const double gain = several(c, factors);
    force.numbers["force"] = list(factors[0] * space_.axes[0] + factors[1] * space_.axes[1]);
    add(force, gain, 2);
  }

  static std::vector<double> list(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

  // A push along one axis, by time; in one trial of the knots, or in all (-1).
  Eigen::VectorXd push_history(const std::function<double(double, int)>& size, int axis,
                               int only) const {
    return space_.coefficients([&](int k, int i) -> Vec3 {
      if (only >= 0 && k != only) return Vec3::Zero();
      return size(i * space_.knots[k].interval, k) * space_.axes[axis];
    });
  }

  // Linear in the stiffness, and in it times the place of its other end.
  void spring() {
    Eigen::MatrixXd c(space_.size(), 3);
    for (int a = 0; a < 2; ++a) c.col(a) = push_history([](double, int) { return 1.0; }, a, -1);
    c.col(2) = space_.coefficients(
        [&](int k, int i) -> Vec3 { return about_ - path_.position[k].row(i).transpose(); });
    Eigen::VectorXd f;
    const double gain = several(c, f);
    // A spring that pushes away from a point is none of the library. What leaves an equilibrium
    // would be an unstable plant.
    if (f[2] <= 0.0) return;
    // A constant force beside a spring is a spring whose end is elsewhere.
    const Vec3 offset = (f[0] * space_.axes[0] + f[1] * space_.axes[1]) / f[2];
    // A spring that is at rest where the place is has no distance, and a refit needs one above
    // zero.
    const double distance = std::max(offset.norm(), 1.0e-3 * scales_.length);
    // Its two numbers cannot be told from one there.
    if (distance > 20.0 * scales_.length) return;  // a constant push
    plant::Effect force = aimed("spring", offset.normalized());
    force.numbers["distance"] = {distance};
    force.numbers["stiffness"] = {f[2]};
    add(force, gain, 3);
  }

  plant::Effect aimed(const std::string& kind, const Vec3& towards) const {
    plant::Effect force = effect(kind);
    force.numbers["about"] = list(about_);
    force.numbers["towards"] = list(towards);
    // Two small angles, in place of a direction of which one length would be idle.
    force.numbers["tilt"] = {0.0, 0.0};
    force.numbers["axis"] = list(tangent_);
    return force;
  }

  // Across the curve, and, where `leaning`, towards both of its ends.
  template <class Call>
  void for_directions(bool leaning, const Call& call) const {
    for (int h = 0; h < headings; ++h) {
      const double angle = 2 * std::numbers::pi * h / headings;
      const Vec3 side = std::cos(angle) * space_.axes[0] + std::sin(angle) * space_.axes[1];
      // 31 degrees: a string to a post beside the plant seldom leads straight across.
      for (const double lean : {-0.6, 0.0, 0.6})
        if (leaning || lean == 0.0) call(Vec3((side + lean * tangent_).normalized()));
    }
  }

  // Offsets between which the force sets in, from where the place seldom goes to where it seldom
  // comes back from.
  std::vector<double> offsets(const Vec3& towards) const {
    std::vector<double> depth;
    for (const Eigen::MatrixXd& x : path_.position)
      for (Eigen::Index i = 0; i < x.rows(); ++i)
        depth.push_back(-towards.dot(x.row(i).transpose() - about_));
    // By how often the place is there, and not by distance: a threshold where the place hardly ever
    // is shows nothing.
    std::ranges::sort(depth);
    std::vector<double> chosen;
    for (int q = 0; q < thresholds; ++q) {
      const double share = 0.04 + 0.92 * q / (thresholds - 1);
      chosen.push_back(
          depth[static_cast<std::size_t>(share * (static_cast<double>(depth.size()) - 1))]);
    }
    // Near the settled place, where such things are first touched.
    const double range = depth.back() - depth.front();
    for (const double near : {-0.02, 0.02}) chosen.push_back(near * range);
    return chosen;
  }

  void unilateral(const std::string& kind, const std::vector<double>& distances) {
    plant::Effect best;
    double most = 0.0;
    // A grid over all that the force is not linear in. From a single start a threshold has no slope
    // towards the right one, where the place never comes to it.
    for_directions(kind == "string", [&](const Vec3& towards) {
      plant::Effect force = aimed(kind, towards);
      force.numbers["stiffness"] = {1.0};
      for (const double distance : distances) {
        // A stop has no other end: it is a string to a point far away.
        if (kind == "string") force.numbers["distance"] = {distance * scales_.length};
        for (const double offset : offsets(towards)) {
          force.numbers["offset"] = {offset};
          keep(force, best, most);
        }
      }
    });
    if (most <= 0.0) return;
    // Steps are of the size of what is left open by the grid.
    const double reach = 0.02 * scales_.length;
    std::vector<Knob> knobs{{"tilt", 0, 0.2, false}, {"offset", 0, reach, false}};
    if (kind == "string") {
      knobs.push_back({"tilt", 1, 0.2, false});
      knobs.push_back({"distance", 0, 0.3, true});
    }
    finish(best, most, knobs);
  }

  void attraction() {
    plant::Effect best;
    double most = 0.0;
    for_directions(true, [&](const Vec3& towards) {
      plant::Effect force = aimed("attraction", towards);
      force.numbers["size"] = {1.0};
      // Magnets and electric charges act from near by: farther ones are constant pushes.
      for (const double distance : {0.1, 0.2, 0.4})
        // A range beyond the distance is a pull that hardly changes; the search may still go there.
        for (const double range : {0.05, 0.2}) {
          force.numbers["distance"] = {distance * scales_.length};
          force.numbers["range"] = {range * scales_.length};
          keep(force, best, most);
        }
    });
    if (most <= 0.0) return;
    finish(best, most,
           {{"tilt", 0, 0.2, false},
            {"tilt", 1, 0.2, false},
            {"distance", 0, 0.3, true},
            {"range", 0, 0.5, true}});
  }

  void keep(const plant::Effect& force, plant::Effect& best, double& most) const {
    double factor = 0.0;
    const double gain = single(force, factor);
    // Of equal ones the first is kept.
    if (gain <= most) return;
    most = gain;
    best = force;
  }

  // Moves one number after the other, by steps that become smaller.
  // A pattern search needs no derivatives, and laws with a threshold have none at it.
  void finish(plant::Effect best, double most, const std::vector<Knob>& knobs) {
    double part = 1.0;
    // Whether a step helped or not it becomes smaller: six rounds end at a thirteenth of the first,
    // near enough for a refit.
    for (int round = 0; round < search_rounds; ++round, part *= 0.6)
      for (const Knob& knob : knobs)
        for (const double sign : {1.0, -1.0}) {
          plant::Effect moved = best;
          // A length by ratio, so that it cannot become negative.
          double& x = moved.numbers.at(knob.name)[knob.component];
          x = knob.relative ? x * std::pow(1.0 + knob.step, sign * part)
                            : x + sign * part * knob.step;
          keep(moved, best, most);
        }
    double factor = 0.0;
    single(best, factor);
    scale_force(best, factor);
    // One more than was searched: its size.
    add(best, most, static_cast<int>(knobs.size()) + 1);
  }

  // One frequency, the same phase in every trial (time counts from each trial's beginning).
  void periodic() {
    // A frequency is looked for before it is fitted, since the gain has many tops over it.
    double slowest = 1.0e9;
    // Knots hear up to half of their own rate. The slowest of the trials, since the force has one
    // frequency in all of them.
    for (const ForceKnots& knots : space_.knots) slowest = std::min(slowest, 0.5 / knots.interval);
    // A record of length T parts frequencies 1/T apart. Five a line do not miss the top of one.
    const double step = 0.2 / scales_.duration;
    double most = 0.0, best = 0.0;
    Eigen::VectorXd factors, kept;
    const auto try_frequency = [&](double frequency) {
      const double w = 2 * std::numbers::pi * frequency;
      // Sine and cosine on both axes: an ellipse of any phase, and linear in all of its numbers.
      Eigen::MatrixXd c(space_.size(), 4);
      for (int a = 0; a < 2; ++a) {
        c.col(a) = push_history([w](double t, int) { return std::sin(w * t); }, a, -1);
        c.col(2 + a) = push_history([w](double t, int) { return std::cos(w * t); }, a, -1);
      }
      const double gain = several(c, factors);
      if (gain <= most) return;
      most = gain, best = frequency, kept = factors;
    };
    // Slower than one period a trial, a push cannot be told from one that drifts. Up to 0.7 of that
    // rate: near the limit a sine between knots is a triangle of another size.
    for (double f = 1.0 / scales_.duration; f < 0.7 * slowest; f += step) try_frequency(f);
    const double near = best;
    // Then finely about the best one, since the refit has a narrow valley to find.
    for (int i = -5; i <= 5; ++i) try_frequency(near + 0.18 * i * step);
    if (most <= 0.0) return;
    plant::Effect force = effect("periodic");
    force.numbers["frequency"] = {best};
    force.numbers["sine"] = list(kept[0] * space_.axes[0] + kept[1] * space_.axes[1]);
    force.numbers["cosine"] = list(kept[2] * space_.axes[0] + kept[3] * space_.axes[1]);
    // Two components of sine and of cosine, and the frequency.
    add(force, most, 5);
  }

  void velocity() {
    // They take energy out and have one number: where nothing else acts, they cost least.
    for (const char* kind : {"drag", "quadratic_drag", "friction"}) {
      plant::Effect force = effect(kind);
      force.numbers[std::string(kind) == "friction" ? "size" : "rate"] = {1.0};
      if (std::string(kind) == "friction") force.numbers["speed"] = {slow};
      double factor = 0.0;
      const double gain = single(force, factor);
      // What drives the plant by its own speed would be a plant that shakes itself.
      if (factor <= 0.0) continue;
      scale_force(force, factor);
      add(force, gain, 1);
    }
  }

  // In one trial: a jolt at any knot, or a push from it on.
  void events() {
    for (const char* kind : {"jolt", "onset"}) {
      const bool jolt = std::string(kind) == "jolt";
      double most = 0.0;
      plant::Effect best;
      for (int k = 0; k < static_cast<int>(space_.knots.size()); ++k)
        // Not at the ends: there a jolt is half a hat, and a wrong start of the trial looks like
        // one.
        for (int i = 1; i < space_.knots[k].count - 1; ++i) {
          const double interval = space_.knots[k].interval, time = i * interval;
          // Other numbers of them are taken as the knots have them; the refit moves them.
          const auto size = [&](double t, int) {
            return jolt ? std::max(0.0, 1.0 - std::abs(t - time) / interval)
                        : (t > time - 0.5 * interval ? 1.0 : 0.0);
          };
          Eigen::MatrixXd c(space_.size(), 2);
          for (int a = 0; a < 2; ++a) c.col(a) = push_history(size, a, k);
          Eigen::VectorXd factors;
          const double gain = several(c, factors);
          if (gain <= most) continue;
          most = gain;
          best = effect(kind);
          best.numbers["force"] = list(factors[0] * space_.axes[0] + factors[1] * space_.axes[1]);
          // Between knots a history rises linearly: half a step before the knot it has half its
          // size.
          best.numbers["time"] = {jolt ? time : time - 0.5 * interval};
          if (jolt) best.numbers["length"] = {interval};
          // By its name, as a file of a hypothesis has it: indices are those of one experiment.
          best.words["trial"] = scales_.trials[space_.knots[k].trial];
        }
      // Its trial is a choice, too.
      if (most > 0.0) add(best, most, 4);
    }
  }

  const ForceSpace& space_;
  const ForcePath& path_;
  const LibraryScales& scales_;
  Vec3 about_, tangent_;
  std::vector<ForceTerm> terms_;
};

}  // namespace

Eigen::VectorXd history_of(const plant::Effect& force, const ForceSpace& space,
                           const ForcePath& path, const LibraryScales& scales) {
  // The same function that the simulator calls, so that a term means the same in both.
  const PointForce law = point_force(force);
  return space.coefficients([&](int k, int i) -> Vec3 {
    if (!law.trial.empty() && scales.trials[space.knots[k].trial] != law.trial) return Vec3::Zero();
    return law.law(i * space.knots[k].interval, path.position[k].row(i).transpose(),
                   path.velocity[k].row(i).transpose());
  });
}

std::vector<ForceTerm> regress_force(const ForceSpace& space, const ForcePath& path,
                                     const LibraryScales& scales) {
  return Library(space, path, scales).run();
}

}  // namespace pedicel::discrepancy
