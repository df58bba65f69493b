#include "plugins/discrepancy/scene_procedure/scene_symptoms.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/io/csv.h"
#include "plugins/discrepancy/scene/scene_effects.h"

namespace pedicel::discrepancy {

namespace {

/// Columns of a table over time, without what weight and inertia of the tool give: the prediction's
/// own course at its own rest stands for them.
/// Measured and predicted go through the same reading, with its threshold, its smoothing and its
/// own rest. What the reading gets wrong is then alike on both sides and cancels.
struct Push {
  std::vector<double> time, normal, across;  // s, N, N
};

/// `width`: s, to either side: short beside a touch, and long beside the samples of a force sensor,
/// whose noise would else cross the threshold before the tool does.
void smooth(const std::vector<double>& time, std::vector<double>& x, double width) {
  // A copy: a running mean must not read what it has written.
  const std::vector<double> given = x;
  std::size_t first = 0, last = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // Two ends that only move forward, so that the whole takes one pass. At the ends of a record
    // the window is shorter and not padded: zeros would bend the course there.
    for (; last < x.size() && time[last] <= time[i] + width; ++last) sum += given[last];
    for (; time[first] < time[i] - width; ++first) sum -= given[first];
    x[i] = sum / static_cast<double>(last - first);
  }
}

/// `noise`: N, of each component; 0 for predictions.
Push push_of(const std::vector<double>& time, const Eigen::MatrixXd& wrench, double noise,
             const SceneSymptomSettings& how) {
  Push out;
  Vec3 rest = Vec3::Zero();
  int count = 0;
  for (long r = 0;
       r < wrench.rows() && time[static_cast<std::size_t>(r)] < time.front() + how.still; ++r)
    // The mean while nothing has moved yet: weight of the tool, and the sensor's zero.
    if (wrench.row(r).head<3>().allFinite()) {
      rest += wrench.row(r).head<3>().transpose();
      ++count;
    }
  if (count > 0) rest /= count;
  // The direction of the strongest push stands for the normal.
  Vec3 most = Vec3::Zero();
  for (long r = 0; r < wrench.rows(); ++r) {
    const Vec3 f = wrench.row(r).head<3>().transpose() - rest;
    // The sensor's own axes say nothing of the contact, and its normal is not measured. A push is
    // strongest along it, while friction stays below it.
    if (f.allFinite() && f.norm() > most.norm()) most = f;
  }
  // Nothing pushes at all: any direction will do, as its course is zero.
  const Vec3 n = most.norm() > 0.0 ? Vec3(most.normalized()) : Vec3(Vec3::UnitX());
  for (long r = 0; r < wrench.rows(); ++r) {
    const Vec3 f = wrench.row(r).head<3>().transpose() - rest;
    if (!f.allFinite()) continue;
    out.time.push_back(time[static_cast<std::size_t>(r)]);
    out.normal.push_back(n.dot(f));
    // A length is never negative, so noise makes it larger: by its variance in each of the two
    // directions across. That is taken off before the root.
    const double across = (f - n * n.dot(f)).squaredNorm();
    out.across.push_back(std::sqrt(std::max(0.0, across - 2.0 * noise * noise)));
  }
  // After the lengths: components that turn would cancel in a mean, and a contact that slips to and
  // fro would look frictionless.
  smooth(out.time, out.normal, how.smoothing);
  smooth(out.time, out.across, how.smoothing);
  return out;
}

double largest(const Push& push) {
  return push.normal.empty() ? 0.0 : *std::ranges::max_element(push.normal);
}

// The first and the last time at which a push of some size is there; NaN where there is none.
std::pair<double, double> touch(const Push& push, double least) {
  double first = std::nan(""), last = std::nan("");
  // Two samples, three apart: one alone may be a spike.
  for (std::size_t i = 0; i + 3 < push.time.size(); ++i) {
    const bool there = std::hypot(push.normal[i], push.across[i]) > least &&
                       std::hypot(push.normal[i + 3], push.across[i + 3]) > least;
    if (!there) continue;
    // The first and the last of all touches. What lies between does not matter: a tool that bounces
    // has touched.
    if (std::isnan(first)) first = push.time[i];
    last = push.time[i + 3];
  }
  return {first, last};
}

class Symptoms {
 public:
  Symptoms(const Experiment& experiment, const SceneDataSet& data,
           std::span<const SceneReadings> predicted, const SceneSymptomSettings& how)
      : experiment_(experiment), data_(data), predicted_(predicted), how_(how) {}

  std::vector<SymptomNumber> run() {
    for (std::size_t t = 0; t < experiment_.trials.size() && t < predicted_.size(); ++t) {
      const Trial& trial = experiment_.trials[t];
      const SceneReadings& model = predicted_[t];
      // A simulation that broke down says nothing after that, and touches would be compared with
      // none.
      if (!model.healthy) continue;
      for (std::size_t w = 0; w < trial.wrenches.size(); ++w)
        if (trial.wrenches[w].size() > 0) contact(trial, trial.wrenches[w], model.wrenches[w], w);
      lag(trial, model);
      for (std::size_t c = 0; c < trial.pixels.size(); ++c)
        image(trial, trial.pixels[c], model.pixels[c], experiment_.cameras[c]);
      standing(trial, model);
      detachment(trial, model);
    }
    std::ranges::stable_sort(found_, [](const SymptomNumber& a, const SymptomNumber& b) {
      // By significance, as the numbers have different units.
      return std::abs(a.value) / a.error > std::abs(b.value) / b.error;
    });
    // Of each kind the clearest trial.
    std::vector<SymptomNumber> kept;
    for (const SymptomNumber& one : found_)
      if (std::ranges::none_of(kept, [&](const SymptomNumber& k) { return k.name == one.name; }))
        kept.push_back(one);
    return kept;
  }

 private:
  void add(const std::string& name, const std::string& of, double value, double error,
           const std::string& unit) {
    SymptomNumber out;
    out.name = name;
    out.of = of;
    out.value = value;
    out.error = error;
    out.unit = unit;
    // Without an error nothing is known of chance, and nothing shows.
    out.shows = error > 0.0 && std::abs(value) > how_.shows_at * error;
    out.speaks_for = scene_spoken_for(name);
    found_.push_back(std::move(out));
  }

  // What a wrist feels is what the tool touches with, so all about contact is read from its wrench.
  void contact(const Trial& trial, const Samples& samples, const Eigen::MatrixXd& model,
               std::size_t sensor) {
    // As stated, or as the samples scatter at rest.
    const double noise = data_.deviation(SceneChannel::force);
    const Push measured = push_of(samples.time, samples.value, noise, how_),
               told = push_of(samples.time, model, 0.0, how_);
    // One threshold for both, from the measured side. With one for each, a model that pushes half
    // as hard would touch at the same time.
    const double least = std::max(how_.clear_push * noise, how_.light_push * largest(measured));
    const auto [begin, end] = touch(measured, least);
    const auto [begin_told, end_told] = touch(told, least);
    // A time is known to the sample, and to the window of the smoothing.
    const double sample = samples.size() > 1
                              ? (samples.time.back() - samples.time.front()) / (samples.size() - 1)
                              : 0.0;
    const auto tell = [&](const std::string& name, double a, double b, const std::string& what) {
      if (std::isnan(a) || std::isnan(b)) return;
      add(name, trial.name, a - b, 1.5 * sample + how_.smoothing / 3.0, "s");
      found_.back().sentence = "In " + trial.name + " the tool " + what + " " +
                               io::format_number(std::abs(a - b), 2) + " s " +
                               (a > b ? "later" : "earlier") + " than simulated, at " +
                               io::format_number(a, 3) + " s.";
    };
    // Both are told, because a robot that is late shifts them in the same way, and a plant that
    // stands elsewhere against each other.
    tell("touch_onset", begin, begin_told, "begins to touch");
    tell("touch_end", end, end_told, "lets go");
    friction(trial, measured, told, noise);
    rest(trial, samples, model, sensor);
  }

  // The ratio while the push is firm, and when it leaves its first value: the contact slips.
  void friction(const Trial& trial, const Push& measured, const Push& told, double noise) {
    const auto ratio = [&](const Push& push, double& error) {
      const double most = largest(push);
      double normal = 0.0, across = 0.0;
      int count = 0;
      for (std::size_t i = 0; i < push.time.size(); ++i) {
        // Of a light push the ratio is one of two noises. Firm is relative to its own largest, so
        // that a model with another stiffness is read over the same part of the push.
        if (push.normal[i] < how_.firm_push * most || most < 2.0 * how_.clear_push * noise)
          continue;
        normal += push.normal[i];
        across += push.across[i];
        ++count;
      }
      // Noise of a sum of `count` readings, over the sum of the normal forces.
      error = count > 0 ? noise * std::sqrt(static_cast<double>(count)) / normal : 0.0;
      return count > 0 ? across / normal : std::nan("");
    };
    double error = 0.0, none = 0.0;
    const double a = ratio(measured, error), b = ratio(told, none);
    if (std::isnan(a) || std::isnan(b)) return;
    // A floor, so that a long push does not make a difference of next to nothing
    // significant.
    add("friction_ratio", trial.name, a - b, std::max(error, how_.ratio_known_to), "1");
    found_.back().sentence = "In " + trial.name + " the tangential force is " +
                             io::format_number(a, 3) + " of the normal one, simulated " +
                             io::format_number(b, 3) + ".";
    const double slip = slip_of(measured, noise), slip_told = slip_of(told, noise);
    if (std::isnan(slip) || std::isnan(slip_told)) return;
    add("slip", trial.name, slip - slip_told, how_.slip_known_to, "s");
    found_.back().sentence = "In " + trial.name + " the contact begins to slip at " +
                             io::format_number(slip, 3) + " s, simulated at " +
                             io::format_number(slip_told, 3) + " s.";
  }

  // When the ratio of a firm push first reaches what it is at most.
  double slip_of(const Push& push, double noise) const {
    std::vector<double> ratios, times;
    for (std::size_t i = 0; i < push.time.size(); ++i)
      if (push.normal[i] > 3.0 * how_.clear_push * noise) {
        ratios.push_back(push.across[i] / push.normal[i]);
        times.push_back(push.time[i]);
      }
    // The 95th percentile of fewer is one sample.
    if (ratios.size() < 20) return std::nan("");
    std::vector<double> sorted = ratios;
    std::ranges::sort(sorted);
    // What the ratio is at most, but for spikes. While a contact sticks the ratio rises, and when
    // it slips it stays: that is Coulomb's law.
    const double high = how_.slip_ratio * sorted[sorted.size() * 95 / 100];
    // Three in a row, so that noise alone does not begin to slip.
    for (std::size_t i = 0; i + 2 < ratios.size(); ++i)
      if (ratios[i] > high && ratios[i + 1] > high && ratios[i + 2] > high) return times[i];
    return std::nan("");
  }

  // Before anything moves: weight and the sensor's zero.
  void rest(const Trial& trial, const Samples& samples, const Eigen::MatrixXd& model,
            std::size_t sensor) {
    Eigen::Matrix<double, 6, 1> off = Eigen::Matrix<double, 6, 1>::Zero();
    int count = 0;
    for (long r = 0; r < samples.size() &&
                     samples.time[static_cast<std::size_t>(r)] < samples.time.front() + how_.still;
         ++r) {
      // Unlike the pushes this is not taken off: here the rest itself is asked for.
      const Eigen::RowVectorXd d = samples.value.row(r) - model.row(r);
      if (!d.allFinite()) continue;
      off += d.transpose();
      ++count;
    }
    // Too few to average, and no error could be told of them.
    if (count < 3) return;
    off /= count;
    const std::string name = experiment_.wrenches[sensor].name;
    const double root = std::sqrt(static_cast<double>(count));
    // The root of three: the length of a vector of three noises.
    add("wrench_at_rest", trial.name, off.head<3>().norm(),
        1.7 * data_.deviation(SceneChannel::force) / root, "N");
    found_.back().sentence = "At rest the sensor " + name + " says " +
                             io::format_number(off.head<3>().norm(), 3) +
                             " N more than weight explains.";
    add("moment_at_rest", trial.name, off.tail<3>().norm(),
        1.7 * data_.deviation(SceneChannel::moment) / root, "N m");
    found_.back().sentence = "At rest the sensor " + name + " says a moment of " +
                             io::format_number(off.tail<3>().norm(), 3) +
                             " N m more than weight explains.";
  }

  // The shift in time of a marker on the arm that takes most of its residual.
  // Markers on the arm and not on the plant: a plant answers late by itself, while an arm is where
  // its log says, but for its clock.
  void lag(const Trial& trial, const SceneReadings& model) {
    double top = 0.0, bottom = 0.0;
    for (std::size_t m = 0; m < experiment_.markers.size(); ++m) {
      if (experiment_.markers[m].plant >= 0 || trial.markers.size() < 3) continue;
      // A delay d makes a residual of -d times the speed, to first order. The rest is a line
      // through the origin by least squares, over all coordinates at once.
      for (long c = 3 * static_cast<long>(m); c < 3 * static_cast<long>(m) + 3; ++c)
        for (long r = 1; r + 1 < trial.markers.size(); ++r) {
          const auto i = static_cast<std::size_t>(r);
          const double speed = (model.markers(r + 1, c) - model.markers(r - 1, c)) /
                               (trial.markers.time[i + 1] - trial.markers.time[i - 1]);
          const double d = trial.markers.value(r, c) - model.markers(r, c);
          if (!std::isfinite(d) || !std::isfinite(speed)) continue;
          top -= d * speed;
          bottom += speed * speed;
        }
    }
    if (bottom <= 0.0) return;
    const double shift = top / bottom;
    // With a floor, so that a long record does not make a lag of next to nothing
    // significant.
    add("robot_lag", trial.name, -shift,
        data_.deviation(SceneChannel::position) / std::sqrt(bottom) + how_.clock_known_to, "s");
    found_.back().sentence =
        "In " + trial.name + " the arm's log is " + io::format_number(1.0e3 * std::abs(shift), 2) +
        " ms " + (shift < 0.0 ? "behind" : "ahead of") + " what the markers on the arm show.";
  }

  // Image residual as a small motion of the camera: two shifts, a turn and a scale.
  // In the image and not in space: which motion of a camera makes them is a question of the fit,
  // and not of what is seen.
  void image(const Trial& trial, const Samples& samples, const Eigen::MatrixXd& model,
             const Camera& camera) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    int count = 0;
    for (long r = 0; r < samples.size(); ++r)
      for (long m = 0; 2 * m + 1 < samples.value.cols(); ++m) {
        // About the centre of the lens, so that turn and scale do not make shifts.
        const Eigen::Vector2d at = model.row(r).segment<2>(2 * m).transpose() - camera.centre;
        const Eigen::Vector2d off =
            (samples.value.row(r) - model.row(r)).segment<2>(2 * m).transpose();
        if (!at.allFinite() || !off.allFinite()) continue;
        Eigen::Matrix<double, 2, 4> j;
        // Derivatives of a small similarity: shift x, shift y, turn by a radian, and scale by one.
        j << 1, 0, -at.y(), at.x(), 0, 1, at.x(), at.y();
        normal += j.transpose() * j;
        right += j.transpose() * off;
        ++count;
      }
    // Four numbers need more than four places, and places along one stem lie nearly on a line.
    if (count < 10) return;
    const Eigen::Vector4d fit = normal.ldlt().solve(right);
    // A camera that turns moves its image by the focal length an angle, whatever the distance.
    const Vec3 turn(fit[1] / camera.focal.y(), -fit[0] / camera.focal.x(), -fit[2]);
    const auto mrad = [](double angle) { return io::format_number(1.0e3 * angle, 2); };
    const double error =
        data_.deviation(SceneChannel::pixel) / std::sqrt(static_cast<double>(count));
    add("image_motion", trial.name, fit.head<2>().norm(), 2.0 * error + how_.pixel_known_to, "px");
    found_.back().sentence = "The image of " + camera.name + " is moved by (" +
                             io::format_number(fit[0], 2) + ", " + io::format_number(fit[1], 2) +
                             ") px, turned by " + io::format_number(1.0e3 * fit[2], 2) +
                             " mrad and scaled by " + io::format_number(1.0 + fit[3], 5) +
                             ", as a camera would that is turned by (" + mrad(turn.x()) + ", " +
                             mrad(turn.y()) + ", " + mrad(turn.z()) + ") mrad in its own frame.";
  }

  // The mean offset of the plant's markers before anything moves.
  void standing(const Trial& trial, const SceneReadings& model) {
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (long r = 0; r < trial.markers.size() && trial.markers.time[static_cast<std::size_t>(r)] <
                                                     trial.markers.time.front() + how_.still;
         ++r)
      for (std::size_t m = 0; m < experiment_.markers.size(); ++m) {
        // Markers on the arm are the business of lag().
        if (experiment_.markers[m].plant < 0) continue;
        const Vec3 d = (trial.markers.value.row(r) - model.markers.row(r))
                           .segment<3>(3 * static_cast<long>(m))
                           .transpose();
        if (!d.allFinite()) continue;
        sum += d;
        ++count;
      }
    if (count < 3) return;
    // A mean over markers: a bend moves them differently and averages out less than a shift, which
    // is common to all.
    const Vec3 mean = sum / count;
    add("plant_shift", trial.name, mean.norm(),
        1.7 * data_.deviation(SceneChannel::position) / std::sqrt(static_cast<double>(count)) +
            how_.place_known_to,
        "m");
    found_.back().sentence = "At rest the plant's markers are off by (" +
                             io::format_number(1.0e3 * mean.x(), 2) + ", " +
                             io::format_number(1.0e3 * mean.y(), 2) + ", " +
                             io::format_number(1.0e3 * mean.z(), 2) + ") mm on average.";
  }

  // When fruits came off, recorded less simulated.
  void detachment(const Trial& trial, const SceneReadings& model) {
    for (const MeasuredEvent& event : trial.events) {
      if (event.event != "detached") continue;
      const auto told = std::ranges::find_if(model.events, [&](const MeasuredEvent& one) {
        return one.event == "detached" && one.what == event.what;
      });
      const std::string when = event.what + " came off at " + io::format_number(event.time, 4) +
                               " s in " + trial.name + ", ";
      // One that stays on in the model is later by the rest of the trial at least.
      const bool stays = told == model.events.end();
      add("detachment", trial.name, event.time - (stays ? trial.duration() : told->time),
          how_.event_known_to, "s");
      found_.back().sentence =
          when + (stays ? "and stays on in the simulation."
                        : "simulated at " + io::format_number(told->time, 4) + " s.");
    }
  }

  const Experiment& experiment_;
  const SceneDataSet& data_;
  std::span<const SceneReadings> predicted_;
  const SceneSymptomSettings& how_;
  std::vector<SymptomNumber> found_;
};

}  // namespace

std::vector<SymptomNumber> scene_symptoms(const Experiment& experiment, const SceneDataSet& data,
                                          std::span<const SceneReadings> predicted,
                                          const SceneSymptomSettings& settings) {
  return Symptoms(experiment, data, predicted, settings).run();
}

}  // namespace pedicel::discrepancy
