#include "plugins/discrepancy/pick/fall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// A level after the fall needs that part of its stretch: what is later may not be recorded.
constexpr double least_level = 1.0 / 3.0;
// Samples are averaged until their noise is that part of the fall: half of it is then known to 18
// %.
constexpr double least_contrast = 16.0;

// Of the largest load, at the end of a record: what is less is no fall that is cut off.
constexpr double least_end_fall = 0.25;

struct Place {
  double time, fall;
  Eigen::VectorXd pull;
};

/// s, the last place at which a fall could be found.
// A hand that opens at the last sample leaves no level after it, and nothing can be said of how the
// fall went on.
double last_place(const PickForce& course, const PickSettings& s) {
  return course.time(course.size() - 1) - s.settle - least_level * s.level;
}

/// Where the level falls most, along what was pulled just before.
// By levels and not by samples: a jerk of the arm swings far up and down, and its mean stays.
std::optional<Place> largest_fall(const PickForce& course, const PickSettings& s) {
  // A whole level has to fit in before it, and a part of one behind.
  const double first = course.time(0) + s.level, last = last_place(course, s);
  std::optional<Place> best;
  for (int i = course.first_at(first); i < course.size() && course.time(i) <= last; ++i) {
    const double t = course.time(i);
    const double from = t + s.settle, to = from + s.level;
    const double end = std::min(to, course.time(course.size() - 1) + course.interval());
    // Records have gaps. A mean over one sample would be called a level.
    if (!course.covers(t - s.level, t) || !course.covers(from, end)) continue;
    const Eigen::VectorXd before = course.mean(t - s.level, t);
    const double size = before.norm();
    // Nothing pulls there, so there is no direction along which it could fall.
    if (size <= 0.0) continue;
    // Along what was pulled: a hand that turns keeps its force and changes its direction.
    const double fall = size - course.mean(from, to).dot(before) / size;
    if (!best || fall > best->fall) best = {t, fall, before / size};
  }
  return best;
}

/// The load along the pull.
class Line {
 public:
  Line(const PickForce& course, const Place& place, const PickSettings& s)
      : course_(course), pull_(place.pull), place_(place), s_(s) {}

  // The highest level near by, since a pull grows until the moment of the break.
  double level_before() const {
    double most = -std::numeric_limits<double>::infinity();
    const double half = 0.5 * s_.level;
    // Two levels back: farther away the pull may have been another one, which had let go before.
    for (int i = course_.first_at(place_.time - 2.0 * s_.level);
         i < course_.size() && course_.time(i) <= place_.time; ++i)
      most =
          std::max(most, course_.mean(course_.time(i) - half, course_.time(i) + half).dot(pull_));
    return most;
  }

  double level_after() const {
    const double from = place_.time + s_.settle + s_.level;
    // A later stretch than that of the search: a freed fruit swings, and pulls for a while after.
    std::vector<double> values = values_in(from, from + 2.0 * s_.level);
    // At the end of a record there is no later one.
    if (values.empty()) values = values_in(place_.time + s_.settle, from);
    // The middle one and not the mean: an arm that moves on begins to pull something else.
    return middle_of(values);
  }

  /// Takes the samples around the fall, averaged over `width` s.
  // Only what is around the fall. Elsewhere steeper falls may be, which do not last.
  void take(double width) {
    const double from = place_.time - s_.level, to = place_.time + s_.settle + s_.level;
    // Around each sample and not behind it, or a fall would come late by half of the width.
    const double half = 0.5 * width;
    // From a little before: where a fall begins is looked for above its steepest part.
    for (int i = course_.first_at(from - 2.0 * s_.response);
         i < course_.size() && course_.time(i) <= to; ++i) {
      const double t = course_.time(i);
      time.push_back(t);
      value.push_back(half > 0.0 ? course_.mean(t - half, t + half).dot(pull_)
                                 : course_.force(i).dot(pull_));
    }
    starts_from = from;
    starts_to = place_.time + s_.settle;
  }

  std::vector<double> time, value;
  double starts_from = 0.0, starts_to = 0.0;  ///< s, between which a fall may begin

 private:
  std::vector<double> values_in(double from, double to) const {
    std::vector<double> values;
    for (int i = course_.first_at(from); i < course_.size() && course_.time(i) < to; ++i)
      values.push_back(course_.force(i).dot(pull_));
    return values;
  }

  const PickForce& course_;
  const Eigen::VectorXd& pull_;
  const Place& place_;
  const PickSettings& s_;
};

struct Half {
  double time;        ///< s
  std::size_t start;  ///< sample from which it is counted
};

/// The shortest time in which the load falls by `lost`, straight between two samples.
// Half of the fall, since its beginning and its end are smeared by everything that is elastic
// between wrist and stalk.
std::optional<Half> shortest(const Line& line, double lost) {
  std::optional<Half> best;
  for (std::size_t i = 0; i < line.time.size(); ++i) {
    if (line.time[i] < line.starts_from || line.time[i] > line.starts_to) continue;
    const double wanted = line.value[i] - lost;
    for (std::size_t j = i + 1; j < line.time.size(); ++j) {
      // It can be no shorter from here. Without that, long records take the square of their length.
      if (best && line.time[j - 1] - line.time[i] >= best->time) break;
      if (line.value[j] > wanted) continue;
      // Slow records have a break between two samples. Straight between them is the least that can
      // be said.
      const double share = (line.value[j - 1] - wanted) / (line.value[j - 1] - line.value[j]);
      const double took =
          line.time[j - 1] + share * (line.time[j] - line.time[j - 1]) - line.time[i];
      if (!best || took < best->time) best = {took, i};
      break;
    }
  }
  return best;
}

/// Where the tangent of the steepest part meets the highest load just before it. An average over
/// `width` s makes a fall that is shorter begin earlier, by half of the difference.
double onset_of(const Line& line, const Half& half, double lost, double width, double reach) {
  const double start = line.time[half.start];
  double top = line.value[half.start];
  for (std::size_t i = half.start; i-- > 0 && line.time[i] >= start - reach;)
    top = std::max(top, line.value[i]);
  // The steepest part does not begin at the top. Its tangent is followed back to there.
  const double back = (top - line.value[half.start]) * half.time / lost;
  // What its half would take without averaging, whose own part is half of the width, in squares. Of
  // a jump nothing is left, and the ramp that was made of it began half a width early.
  const double own = std::sqrt(std::max(0.0, half.time * half.time - 0.25 * width * width));
  // Not farther back than was looked. A flat tangent would lead anywhere.
  return start - std::min(back, reach + width) + std::max(0.0, 0.5 * width - own);
}

/// At least one, at most what fits into a level.
double samples_to_average(const PickForce& course, double lost, const PickSettings& s) {
  // Noise of a mean falls with the root of the count, so the count goes with the square.
  const double wanted = std::ceil(std::pow(0.5 * least_contrast * course.noise() / lost, 2.0));
  return std::clamp(wanted, 1.0, std::max(1.0, std::floor(s.level / course.interval())));
}

/// N along the load, in the level before the last place.
double level_at_end(const PickForce& course, const LargestLoad& load, const PickSettings& s) {
  // Not in the very last samples, where recorders are stopped and arms let go.
  const double to = last_place(course, s);
  return course.mean(to - s.level, to).dot(load.pull);
}

}  // namespace

std::string check(const PickSettings& s) {
  // Settings come from a command line. Ten seconds are longer than any pull.
  const std::pair<const char*, double> times[] = {
      {"rest", s.rest}, {"response", s.response}, {"level", s.level}, {"settle", s.settle}};
  for (const auto& [name, value] : times)
    if (!(value > 0.0 && value <= 10.0))
      return std::string(name) + text(" = %g s: must be above 0 and at most 10 s", value);
  if (!(s.sharpness > 0.0 && s.sharpness <= 100.0))
    return text("sharpness = %g: must be above 0 and at most 100", s.sharpness);
  if (!(s.share > 0.0 && s.share <= 1.0))
    return text("share = %g: must be above 0 and at most 1", s.share);
  return {};
}

std::optional<Fall> find_fall(const PickForce& course, const PickSettings& s) {
  if (course.size() < 3) return std::nullopt;
  const std::optional<Place> place = largest_fall(course, s);
  // Shorter than two levels and the time to settle between them.
  if (!place) return std::nullopt;
  Line line(course, *place, s);
  Fall fall;
  fall.time = fall.onset = place->time;
  fall.pull = place->pull;
  // The search had to find the place only. Now levels are taken where they are clear of the fall
  // itself.
  fall.before = line.level_before();
  fall.after = line.level_after();
  fall.share = fall.before > 0.0 ? (fall.before - fall.after) / fall.before : 0.0;
  const double lost = 0.5 * (fall.before - fall.after);
  // The levels taken with more care are not those of the search: they may show no fall.
  if (lost <= 0.0) return fall;
  const double averaged = samples_to_average(course, lost, s);
  // Only where noise asks for it. Averaging makes any break slower, and the limit grows with it.
  if (averaged > 1.0) fall.smoothing = averaged * course.interval();
  line.take(fall.smoothing);
  const std::optional<Half> half = shortest(line, lost);
  // Slower than all that was looked at. It still is a fall, with levels and without a time.
  if (!half) return fall;
  // Noise of a level divided by its slope is noise of a time.
  const double by_noise = course.noise() / std::sqrt(averaged) * half->time / lost;
  // Two ends, each anywhere within a sample: two variances of a twelfth.
  const double by_samples = course.interval() / std::sqrt(6.0);
  fall.half = half->time;
  fall.half_error = std::hypot(std::sqrt(2.0) * by_noise, by_samples);
  fall.onset = onset_of(line, *half, lost, fall.smoothing, 2.0 * s.response);
  // The curve of a break is not known. Half of its time is what the tangent may be off by.
  fall.onset_error = std::hypot(0.5 * half->time, by_noise, by_samples);
  return fall;
}

LargestLoad largest_load(const PickForce& course, const PickSettings& s) {
  LargestLoad load;
  load.pull = Eigen::VectorXd::Zero(course.axes());
  for (int i = 0; i < course.size(); ++i) {
    const double t = course.time(i);
    // A level and not a sample: a spike is no load.
    const Eigen::VectorXd level = course.mean(t - 0.5 * s.level, t + 0.5 * s.level);
    if (const double size = level.norm(); size > load.force) load = {t, size, level / size};
  }
  return load;
}

// No fall lasts: then what is left at the end is compared with the most there ever was.
Fall whole_fall(const PickForce& course, const LargestLoad& load, const PickSettings& s) {
  Fall fall;
  fall.pull = load.pull;
  fall.time = fall.onset = load.time;
  fall.before = load.force;
  fall.after = level_at_end(course, load, s);
  fall.share = (fall.before - fall.after) / fall.before;
  return fall;
}

Beginning beginning_of(const PickForce& course, const Fall& fall, const PickSettings& s) {
  const double lost = fall.before - fall.after, half_width = 0.5 * s.response;
  // A fall with a half ends near its place. Without one it may go on to the end of the record.
  const double end =
      fall.half ? fall.time + s.settle + 2.0 * s.level : course.time(course.size() - 1);
  // From behind: where the load was last above what is left then.
  // A slip has no steep part. From a tenth to a half are four tenths of it: a quarter of that leads
  // back to where nothing was gone.
  double half_gone = fall.time, tenth_gone = fall.time;
  bool found_half = false;
  for (int i = std::min(course.first_at(end), course.size() - 1); i >= 0; --i) {
    const double t = course.time(i);
    const double load = course.mean(t - half_width, t + half_width).dot(fall.pull);
    if (!found_half && load >= fall.before - 0.5 * lost) half_gone = t, found_half = true;
    if (!found_half || load < fall.before - 0.1 * lost) continue;
    tenth_gone = t;
    break;
  }
  const double back = 0.25 * (half_gone - tenth_gone);
  return {tenth_gone - back, std::hypot(back, half_width, course.interval())};
}

bool ends_in_a_fall(const PickForce& course, const LargestLoad& load, const PickSettings& s) {
  const double end = course.time(course.size() - 1);
  // Over one response: less would be noise, more would hide that it has just gone.
  const double last = course.mean(end - s.response, end + course.interval()).dot(load.pull);
  const double before = level_at_end(course, load, s), left = (1.0 - s.share) * load.force;
  // The fall must begin within the record and be large: at the end of one, arms often just stop.
  return before > left && last <= left && before - last >= least_end_fall * load.force;
}

}  // namespace pedicel::discrepancy
