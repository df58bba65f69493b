#include "plugins/discrepancy/force/force_course.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

constexpr double small_share = 0.05;  // of the largest force, that is none

// Of a history and of a simulated law alike, so that both are told in the same words.
struct Moment {
  Vec3 force, velocity;  // N and m/s, W
  double seconds = 0.0;
};

// Work alone would say little: a spring gives back what it takes, and so does a force that hardly
// acts. Over the turnover, the sum without signs, it is a number between -1 and 1.
ForceCourse course_of(const std::vector<Moment>& moments) {
  ForceCourse course;
  for (const Moment& moment : moments) course.most = std::max(course.most, moment.force.norm());
  double work = 0.0, turnover = 0.0, active = 0.0, all = 0.0;
  for (const auto& [force, velocity, seconds] : moments) {
    work += force.dot(velocity) * seconds;
    turnover += std::abs(force.dot(velocity)) * seconds;
    // A history by a Gaussian process is nowhere zero: what counts as acting is relative to the
    // most.
    active += force.norm() > small_share * course.most ? seconds : 0.0;
    all += seconds;
  }
  if (all > 0.0) course.active = active / all;
  // A force on a place that does not move does no work, and no share of it either.
  if (turnover > 0.0) course.work = work / turnover;
  return course;
}

}  // namespace

ForceCourse course_of_history(const ForceSpace& space, const ForcePath& path,
                              const Eigen::VectorXd& history) {
  std::vector<Moment> moments;
  for (std::size_t k = 0; k < space.knots.size(); ++k) {
    const ForceKnots& knots = space.knots[k];
    for (int i = 0; i < knots.count; ++i) {
      Vec3 force = Vec3::Zero();
      // Coefficients are components across the curve. What acts along it was not asked for.
      for (std::size_t a = 0; a < space.axes.size(); ++a)
        force += history[knots.first + static_cast<int>(a) * knots.count + i] * space.axes[a];
      // Along the path of the place with the force in it: what it does to the plant as it moved,
      // not as it would have moved without.
      moments.push_back({force, path.velocity[k].row(i).transpose(), knots.interval});
    }
  }
  return course_of(moments);
}

ForceCourse course_of_law(Simulator& simulator, const Hypothesis& model,
                          std::span<const int> trials) {
  std::vector<std::vector<Moment>> heard(trials.size());
  std::vector<double> last(trials.size(), 0.0);
  std::vector<Variant> variants(trials.size(), model.variant());
  std::vector<Simulator::Request> requests;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    // The law is heard while it is simulated: its place may lie between markers, where nobody else
    // knows the motion. Each trial has a list of its own, as trials run side by side. The last
    // force is the one that was found. A model may have others before it.
    auto& law = variants[t].forces.back().law;
    law = [plain = law, &moments = heard[t], &before = last[t]](double time, const Vec3& x,
                                                                const Vec3& v) -> Vec3 {
      const Vec3 force = plain(time, x, v);
      // The solver may ask for a time twice; the second one then counts for nothing.
      moments.push_back({force, v, std::max(0.0, time - before)});
      before = time;
      return force;
    };
    requests.push_back({&variants[t], trials[t]});
  }
  // For what the laws heard. The predictions are not needed.
  simulator.run(requests);
  // One course over all trials: what a force does is told once.
  std::vector<Moment> all;
  for (const std::vector<Moment>& moments : heard)
    all.insert(all.end(), moments.begin(), moments.end());
  return course_of(all);
}

std::string when_it_acts(const ForceCourse& course, const std::string& kind) {
  const std::string size = text("it reaches %.2g N", course.most);
  // How long it acts would be told of the others alone: a sine is small at times without having
  // stopped.
  if (kind == "periodic") return size + ", and comes back with time, whatever the plant does";
  if (kind == "jolt" || kind == "onset") return size + ", in one trial alone";
  return size + text(", and acts in %.0f %% of the time", 100.0 * course.active) +
         (kind == "string" || kind == "stop" ? ", by where the plant is" : "");
}

std::string what_it_does(const ForceCourse& course) {
  // Half of its turnover: below that a force gives back most of what it takes, as springs and
  // constant pushes do.
  const std::string what = course.work < -0.5  ? "it takes energy out"
                           : course.work > 0.5 ? "it drives the plant"
                                               : "it gives back about what it takes";
  // With the number, as the words are three for a whole range.
  return what + text(" (work over turnover %.2f)", course.work);
}

}  // namespace pedicel::discrepancy
