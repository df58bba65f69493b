#include "plugins/discrepancy/admission/load_answers.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace pedicel::discrepancy {

namespace {

// The range of a thousand samples of noise is six or seven deviations.
constexpr double at_rest = 10.0;  // times the noise: the range of a marker at rest
constexpr double leaves = 6.0;    // times the noise, from the mean of its rest
// A swing that turns stays as near to one place for a short time, but not for so long.
constexpr double least_rest = 0.25;  // s
constexpr int least_samples = 5;     // at rest
constexpr std::size_t turning_samples = 3;
constexpr double turning = 20.0;     // times the noise
constexpr double short_rest = 0.15;  // of the longest
// More are a force that was recorded, with a change in every row.
constexpr std::size_t most_changes = 200;

/// When the loads change after the record begins, and by what.
struct Change {
  double time = 0.0;
  Vec3 force = Vec3::Zero();  ///< N
};

Vec3 force_at(const Trial& trial, double t) {
  Vec3 sum = Vec3::Zero();
  for (const TimedLoad& load : trial.loads)
    if (t >= load.from && t < load.to) sum += load.force;
  return sum;
}

std::vector<Change> changes_of(const Trial& trial, const Track& track) {
  // In order and once each: a load that follows another at once is one change. From all loads
  // together: what a marker sees is their sum.
  std::set<double> times;
  for (const TimedLoad& load : trial.loads)
    // Changes before the first sample are not seen; they are part of where it begins.
    for (const double t : {load.from, load.to})
      if (t > track.time.front() && std::isfinite(t)) times.insert(t);
  std::vector<Change> changes;
  Vec3 before = force_at(trial, track.time.front());
  for (const double t : times) {
    const Vec3 force = force_at(trial, t);
    // One load may take the place of another that is the same.
    if ((force - before).norm() > 0.0) changes.push_back({t, force - before});
    before = force;
  }
  return changes;
}

/// A marker at rest: from the first row to the last, and where it is.
struct Rest {
  std::size_t first = 0, last = 0;
  Vec3 place = Vec3::Zero();
};

// A box around the samples that is no larger than the noise makes it.
std::vector<Rest> rests_of(const Track& track, double noise) {
  std::vector<Rest> rests;
  const std::size_t count = track.time.size();
  for (std::size_t first = 0; first < count;) {
    Vec3 low = track.place[first], high = low, sum = Vec3::Zero();
    std::size_t row = first;
    for (; row < count; ++row) {
      const Vec3 next_low = low.cwiseMin(track.place[row]);
      const Vec3 next_high = high.cwiseMax(track.place[row]);
      // A box and not a deviation: one sample that leaves ends a rest.
      if ((next_high - next_low).maxCoeff() > at_rest * noise) break;
      const double rows = static_cast<double>(row - first);
      if (row - first >= least_samples &&
          // From a mean that is itself known to the noise of so many samples.
          (track.place[row] - sum / rows).norm() > leaves * noise * std::sqrt(1.0 + 1.0 / rows) &&
          // Two in a row, or an outlier would end it.
          row + 1 < count && (track.place[row + 1] - sum / rows).norm() > leaves * noise)
        break;
      low = next_low;
      high = next_high;
      sum += track.place[row];
    }
    const std::size_t rows = row - first;
    if (rows >= least_samples && track.time[row - 1] - track.time[first] >= least_rest) {
      rests.push_back({first, row - 1, sum / static_cast<double>(rows)});
      first = row;
      // On by one row only: the next rest may begin anywhere.
    } else {
      ++first;
    }
  }
  return rests;
}

// Two rests in one place are one, and so are those that follow at once, nearly in one place: a
// swing that dies out. What is short beside the longest is where a swing turns.
std::vector<Rest> distinct(const Track& track, const std::vector<Rest>& rests, double noise) {
  std::vector<Rest> found;
  for (const Rest& rest : rests) {
    const double way = found.empty() ? 0.0 : (rest.place - found.back().place).norm();
    // A swing that dies out looks like many short rests.
    const bool at_once = !found.empty() && rest.first - found.back().last <= turning_samples &&
                         way < turning * noise;
    bool same = !found.empty() && way < leaves * noise;
    // A stretch between two rests in one place may have been an answer that went back. Only where
    // the marker stayed near are they one.
    if (same && !at_once)
      for (std::size_t row = found.back().last; row < rest.first; ++row)
        same = same && (track.place[row] - rest.place).norm() < 2.0 * leaves * noise;
    if (!same && !at_once) {
      found.push_back(rest);
      continue;
    }
    found.back().last = rest.last;
    // Where it has come to rest at last is where it is.
    if (at_once) found.back().place = rest.place;
  }
  const auto lasts = [&](const Rest& rest) {
    return track.time[rest.last] - track.time[rest.first];
  };
  double longest = 0.0;
  // Relative to the longest, since plants are slow or fast.
  for (const Rest& rest : found) longest = std::max(longest, lasts(rest));
  // A swing stands still for a short time where it turns, and a slow plant for longer than any
  // fixed limit.
  std::erase_if(found, [&](const Rest& rest) { return lasts(rest) < short_rest * longest; });
  return found;
}

// From when it leaves until it has gone half of its way.
double rise(const Track& track, const Rest& from, const Rest& to) {
  const Vec3 way = to.place - from.place;
  std::size_t row = from.last + 1;
  // Half and not all: a plant comes to rest slowly, and where that ends is a matter of noise.
  while (row < to.last && (track.place[row] - from.place).dot(way) < 0.5 * way.squaredNorm()) ++row;
  return track.time[row] - track.time[from.last];
}

}  // namespace

LoadAnswers load_answers(const Trial& trial, const Track& track, double noise) {
  // Without any noise rest has no measure.
  if (track.time.size() < 2 * least_samples || noise <= 0.0) return {};
  const std::vector<Change> changes = changes_of(trial, track);
  // Loads that change all the time leave no rests between them.
  if (changes.empty() || changes.size() > most_changes) return {};
  const std::vector<Rest> rests = distinct(track, rests_of(track, noise), noise);
  // More rests than changes: something else moves the plant, and no answer is an answer.
  if (rests.size() < 2 || rests.size() > changes.size() + 1) return {};
  LoadAnswers answers;
  for (std::size_t i = 0; i + 1 < rests.size(); ++i) {
    // Along the change: what goes aside says nothing of its sign.
    const double way = (rests[i + 1].place - rests[i].place).dot(changes[i].force.normalized());
    answers.all.push_back(
        // The first sample that left counts as when it was seen.
        {changes[i].time, track.time[rests[i].last + 1], way, rise(track, rests[i], rests[i + 1])});
  }
  // A change after the record's end has no answer in it, and is not missing.
  const auto within = std::ranges::count_if(
      changes, [&](const Change& change) { return change.time < track.time.back(); });
  answers.complete = within == std::ssize(answers.all);
  return answers;
}

}  // namespace pedicel::discrepancy
