// Copies. Two measurements never agree to the last digit.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "plugins/discrepancy/admission/beside.h"
#include "plugins/discrepancy/data/sentence.h"

namespace pedicel::discrepancy {

namespace {

// Of fewer rows equality may be chance where numbers are written short.
constexpr int least_rows = 5;
// Ten rows that are equal in every digit are no chance, even of numbers that are cut short.
constexpr int least_run = 10;    // rows
constexpr int least_still = 20;  // rows, and of all rows:
constexpr double still_share = 0.25;
constexpr double least_scatter = 1.0e-6;  // m: of less the data are of a simulation without noise

bool is_same(const Samples& a, const Samples& b) {
  if (a.size() != b.size() || a.size() < least_rows || a.value.cols() != b.value.cols())
    return false;
  // Gaps count as equal: a copy has them in the same rows.
  const auto equal =
      (a.value.array() == b.value.array()) || (a.value.array().isNaN() && b.value.array().isNaN());
  return equal.all();
}

bool is_same_row(const Samples& a, int i, const Samples& b, int j) {
  return std::ranges::equal(a.value.row(i), b.value.row(j), [](double x, double y) {
    return x == y || (std::isnan(x) && std::isnan(y));
  });
}

std::uint64_t hash_of(const Samples& samples, int row) {
  std::uint64_t hash = 1469598103934665603u;  // FNV-1a, by numbers in place of bytes
  for (const double x : samples.value.row(row)) {
    // By hash, because each row is looked for among all rows of all other tables. Plus zero makes
    // minus zero the same; every row that is found is compared itself.
    const std::uint64_t bits = std::isnan(x) ? 1 : std::bit_cast<std::uint64_t>(x + 0.0);
    hash = (hash ^ bits) * 1099511628211u;
    hash ^= hash >> 29;
  }
  return hash;
}

/// Rows of one table that stand in another table, or earlier in the same, one after the other.
struct Run {
  int from = 0, there = 0, rows = 0;
};

/// The rows of one table by what they hold: each as it comes first.
class Rows {
 public:
  explicit Rows(const Samples& samples) : samples_(samples) {
    for (int row = 0; row < samples.size(); ++row) {
      // Rows without a marker are equal wherever they are.
      if (!samples.value.row(row).array().isFinite().any()) continue;
      // The first of equal rows stands for all: a marker at rest repeats its row, and each
      // repetition would be a run.
      const auto [first, is_new] = first_.try_emplace(hash_of(samples, row), row);
      if (!is_new) note_again(row, first->second);
    }
  }

  /// That stands earlier in the same table.
  const Run& again() const { return again_; }

  /// That stands in another table, too. Runs that are long enough have one row in so many.
  Run in(const Samples& other) const {
    // The longest tells most: a table may have several parts of the same other one.
    Run longest;
    // Half of the least run, so that none falls between two looks.
    for (int row = 0; row < other.size(); row += least_run / 2) {
      const auto known = first_.find(hash_of(other, row));
      if (known == first_.end()) continue;
      const Run run = around(known->second, other, row);
      if (run.rows > longest.rows) longest = run;
      // On from the run's end, since the step that follows adds the half again.
      row = std::max(row, run.there + run.rows - least_run / 2);
    }
    return longest;
  }

 private:
  // What stands still comes first in one place: no run.
  void note_again(int row, int first) {
    // A run grows only while both sides go on together. A marker that swings passes a place twice,
    // once in a while and not row after row.
    if (open_.rows > 0 && row == open_.from + open_.rows && first == open_.there + open_.rows)
      ++open_.rows;
    else
      open_ = {row, first, 1};
    if (open_.rows > again_.rows) again_ = open_;
  }

  bool comes_first(int row) const { return first_.at(hash_of(samples_, row)) == row; }

  Run around(int row, const Samples& other, int there) const {
    Run run{row, there, 0};
    const auto goes_on = [&](int i, int j) {
      return i >= 0 && j >= 0 && i < samples_.size() && j < other.size() &&
             is_same_row(samples_, i, other, j) && first_.contains(hash_of(samples_, i)) &&
             comes_first(i);
    };
    // Back as well: the row that was hit lies somewhere within.
    while (goes_on(run.from - 1, run.there - 1)) {
      --run.from;
      --run.there;
    }
    while (goes_on(run.from + run.rows, run.there + run.rows)) ++run.rows;
    return run;
  }

  const Samples& samples_;
  std::unordered_map<std::uint64_t, int> first_;
  Run again_, open_;
};

Fault two_records(const Samples& samples, const Run& run, const std::string& there) {
  return {"markers.csv", text("holds from %.4g to %.4g s the same numbers as ",
                              samples.time[run.from], samples.time[run.from + run.rows - 1]) +
                             there + ": expected the trial's own; two records in one table?"};
}

// All markers in one place to the last digit, for good: where numbers are written finer than the
// noise, that is a row copied down, or a tracker that lost them all.
std::optional<Fault> copied_down(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  // A short record may well be at rest all the time. No share of so few rows says anything.
  if (samples.size() < least_still) return std::nullopt;
  // The smallest step that the table knows is about its last digit.
  double finest = std::numeric_limits<double>::infinity();
  for (int row = 1; row < samples.size(); ++row)
    for (Eigen::Index c = 0; c < samples.value.cols(); ++c) {
      const double step = std::abs(samples.value(row, c) - samples.value(row - 1, c));
      if (step > 0.0) finest = std::min(finest, step);
    }
  // From the end: a row that was copied down goes on to the end. Rows in which no marker was seen
  // are gaps, and say nothing.
  int last = samples.size() - 1;
  while (last > 0 && !samples.value.row(last).array().isFinite().any()) --last;
  int first = last;
  while (first > 0 && is_same_row(samples, first - 1, samples, last)) --first;
  const int rows = last + 1 - first;
  if (rows < std::max<double>(least_still, still_share * samples.size())) return std::nullopt;
  // Numbers written as coarsely as the noise stand still by themselves.
  if (finest > 0.5 * noise_of_markers(view)) return std::nullopt;
  return Fault{"markers.csv",
               text("has all markers stand still to the last digit from %.4g s on, in %.0f rows",
                    samples.time[first], rows) +
                   ": expected noise; a row copied down, or markers that were lost?"};
}

// Two records put together into one table, or a table that begins again.
std::optional<Fault> copied_rows(const TrialView& view) {
  const Samples& samples = view.trial.markers;
  // Of each trial once, however many others it is compared with.
  const Rows rows(samples);
  // Within a table first: put together of two parts, it would be found in the other trial, too.
  if (rows.again().rows >= least_run)
    return two_records(samples, rows.again(), "earlier rows of its own");
  for (const Trial& other : view.experiment.trials) {
    if (&other == &view.trial || other.markers.value.cols() != samples.value.cols()) continue;
    // Whole tables are told by another sentence.
    if (is_same(samples, other.markers)) continue;
    const Run run = rows.in(other.markers);
    // Of two trials the one in which they do not stand where the record begins.
    if (run.rows < least_run || run.from < run.there) continue;
    // At the same rows nothing tells them apart: the later trial is told, as somebody copied what
    // there was.
    if (run.from == run.there && &other > &view.trial) continue;
    return two_records(samples, run, (other.folder / "markers.csv").string());
  }
  return std::nullopt;
}

double explained(const TrialView& view) {
  double most = 0.0;
  if (view.nominal_plant)
    // The best of its drives: one is enough to say that these markers belong to what was done.
    for (const Beside& beside : Beside::all_of(view)) most = std::max(most, beside.explained());
  return most;
}

// Of two equal ones: that which does less what its trial does to the plant, or comes later.
bool is_the_copy(const TrialView& one, const TrialView& other) {
  const double mine = explained(one), others = explained(other);
  // Trials stand in one list, so an address tells which comes later.
  return mine == others ? &one.trial > &other.trial : mine < others;
}

}  // namespace

std::optional<Fault> check_copies(const TrialView& view) {
  // Simulated without noise, two trials with the same drive are equal, and rightly so.
  if (noise_of_markers(view) < least_scatter) return std::nullopt;
  for (const Trial& other : view.experiment.trials) {
    if (&other == &view.trial || !is_same(view.trial.markers, other.markers)) continue;
    // Each pair is met twice, from either side; only one of the two is told.
    if (!is_the_copy(view, {view.experiment, other, view.nominal_plant})) continue;
    return Fault{"markers.csv", "holds the same numbers as " +
                                    (other.folder / "markers.csv").string() +
                                    ": expected the trial's own; a file copied?"};
  }
  if (auto fault = copied_down(view)) return fault;
  return copied_rows(view);
}

}  // namespace pedicel::discrepancy
