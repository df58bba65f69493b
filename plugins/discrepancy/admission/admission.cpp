#include "plugins/discrepancy/admission/admission.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "plugins/discrepancy/admission/following.h"
#include "plugins/discrepancy/data/labels.h"
#include "plugins/discrepancy/data/trial_name.h"
#include "plugins/discrepancy/simulate/trial_run.h"

namespace pedicel::discrepancy {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr int reach = 20;                // samples on either side that say what scatter is usual
constexpr double outlying = 10.0;        // times that scatter
constexpr double normal_scale = 1.4826;  // deviation of a normal distribution over its median
// A marker at rest seldom repeats one number so often: trackers write finer than they see.
constexpr int stuck_samples = 20;

double median(std::vector<double>& values) {
  // A median and not a mean square: what is looked for would raise its own measure.
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What a sample has against the cubic through its two neighbours on either side.
double from_neighbours(const Eigen::Ref<const Eigen::VectorXd>& x, int i) {
  // At the ends there is no cubic, and nothing is said. A cubic follows a swing through its turns,
  // which a mean of two neighbours would call outlying.
  if (i < 2 || i + 2 >= x.size()) return nothing;
  return std::abs(x[i] - (4.0 * (x[i - 1] + x[i + 1]) - (x[i - 2] + x[i + 2])) / 6.0);
}

// The usual scatter around sample i, which it and those next to it take no part in, nor stretches
// of one value: beside a force that is zero after its release, noise would look outlying.
double scatter_near(const std::vector<double>& distance, int i) {
  std::vector<double> near;
  const int last = static_cast<int>(distance.size()) - 1;
  for (int k = std::max(0, i - reach); k <= std::min(i + reach, last); ++k)
    // Two to either side: the cubic of a neighbour has this sample in it.
    if (std::abs(k - i) > 2 && std::isfinite(distance[k]) && distance[k] > 0.0)
      near.push_back(distance[k]);
  // Of few distances the median is chance, and no sample is called outlying by it.
  return static_cast<int>(near.size()) >= reach / 2 ? median(near)
                                                    : std::numeric_limits<double>::infinity();
}

// Samples next to which the force jumps, because something is let go or loaded; light tips start to
// move there within a sample.
std::vector<char> beside_jumps(const Trial& trial, const std::vector<double>& time) {
  std::vector<char> beside(time.size(), 0);
  // A sample that is true and far from its cubic is worth more than most: it says when it began.
  for (const double jump : jumps_of(trial, trial.effects)) {
    const auto after = std::lower_bound(time.begin(), time.end(), jump) - time.begin();
    for (auto i = std::max<std::ptrdiff_t>(after - 2, 0); i < after + 2; ++i)
      if (i < static_cast<std::ptrdiff_t>(time.size())) beside[i] = 1;
  }
  return beside;
}

// A marker's points, of which outliers are taken out one by one. How outlying a point is: the
// squares of those distances over the scatter, summed over the axes, since it is far out in some
// direction, which need not be an axis. One axis may scatter little by chance, being judged by a
// few neighbours; no instrument sees one twice as well as the other two.
class Points {
 public:
  explicit Points(Eigen::Ref<Eigen::MatrixXd> xyz) : xyz_(xyz), excess_(xyz.rows(), 0.0) {
    distance_.fill(std::vector<double>(xyz.rows(), nothing));
    judge(0, size() - 1);
  }

  int size() const { return static_cast<int>(xyz_.rows()); }
  double excess(int i) const { return excess_[i]; }

  // All its numbers go, and what lies next to it is judged anew.
  void take_out(int i) {
    xyz_.row(i).setConstant(nothing);
    judge(std::max(0, i - 2), std::min(i + 2, size() - 1));
  }

 private:
  // What changes with the points from `first` to `last`.
  void judge(int first, int last) {
    for (int c = 0; c < 3; ++c)
      for (int i = first; i <= last; ++i) distance_[c][i] = from_neighbours(xyz_.col(c), i);
    for (int i = std::max(0, first - reach); i <= std::min(last + reach, size() - 1); ++i) {
      std::array<double, 3> scatter;
      for (int c = 0; c < 3; ++c) scatter[c] = scatter_near(distance_[c], i);
      std::array<double, 3> sorted = scatter;
      std::ranges::sort(sorted);
      // Half of the middle one of the three: an axis along which the plant hardly moves may well be
      // quiet, but not at will.
      const double least = std::isfinite(sorted[1]) ? 0.5 * sorted[1] : 0.0;
      excess_[i] = 0.0;
      for (int c = 0; c < 3; ++c)
        if (std::isfinite(distance_[c][i]) && distance_[c][i] > 0.0)
          excess_[i] += std::pow(distance_[c][i] / (normal_scale * std::max(scatter[c], least)), 2);
    }
  }

  Eigen::Ref<Eigen::MatrixXd> xyz_;
  std::array<std::vector<double>, 3> distance_;
  std::vector<double> excess_;
};

// The worst first: an outlying point makes its neighbours look outlying. `spared` stay.
int take_out_outliers(Eigen::Ref<Eigen::MatrixXd> xyz, const std::vector<char>& spared) {
  Points points(xyz);
  for (int count = 0;; ++count) {
    int worst = -1;
    // Squares of three axes against the square of one: noise of all three together is still far
    // below.
    double most = outlying * outlying;
    for (int i = 0; i < points.size(); ++i) {
      if (spared[i] || !(points.excess(i) > most) || !std::isfinite(points.excess(i))) continue;
      most = points.excess(i);
      worst = i;
    }
    // Found anew after each, since a point that is gone no longer pulls at its neighbours' cubics.
    // Each pass takes out one, so it ends after as many as there are points.
    if (worst < 0) return count;
    points.take_out(worst);
  }
}

int count_points(const Eigen::MatrixXd& xyz) {
  return static_cast<int>((!xyz.array().isNaN()).rowwise().any().count());
}

int take_out_stuck(Eigen::Ref<Eigen::VectorXd> x) {
  // By exact equality: instruments that read the same to the last digit for so long have stopped.
  int count = 0, begin = 0;
  for (int i = 1; i <= x.size(); ++i) {
    if (i < x.size() && x[i] == x[begin]) continue;
    // What is missing is "equal" to nothing, and stays as it is.
    if (i - begin >= stuck_samples && std::isfinite(x[begin])) {
      count += i - begin;
      x.segment(begin, i - begin).setConstant(nothing);
    }
    begin = i;
  }
  return count;
}

// Gaps that a program filled: in all three axes nearer to the cubic through their neighbours than
// measured ones ever are. Straight lines and splines are such cubics.
constexpr int filled_samples = 12;
constexpr double filled = 0.02;       // of the noise
constexpr double least_noise = 1e-6;  // m: of less the data are of a simulation

// What stands still is for take_out_stuck(): where numbers are cut short, many do.
int take_out_filled(Eigen::Ref<Eigen::MatrixXd> xyz, double noise) {
  int count = 0, begin = 0;
  std::vector<char> is_filled(xyz.rows(), 0);
  for (int i = 0; i < static_cast<int>(xyz.rows()); ++i) {
    // All three axes: one of them may lie on a line for a while by chance. Noise is 1.4 of its
    // deviations away from the cubic (the root of 70/36); so near to it in all three is one sample
    // in a million.
    is_filled[i] = i > 0 && xyz.row(i) != xyz.row(i - 1);
    for (int c = 0; c < 3 && is_filled[i]; ++c)
      is_filled[i] = from_neighbours(xyz.col(c), i) < filled * noise;
  }
  for (int i = 0; i <= static_cast<int>(xyz.rows()); ++i) {
    if (i < static_cast<int>(xyz.rows()) && is_filled[i]) continue;
    // A swing near its turn lies near a cubic for a few samples.
    if (i - begin >= filled_samples) {
      count += i - begin;
      xyz.middleRows(begin, i - begin).setConstant(nothing);
    }
    begin = i + 1;
  }
  return count;
}

int count_finite(const Eigen::MatrixXd& value) {
  return static_cast<int>(value.array().isFinite().count());
}

// When a fruit came off is known to a sample, and a plant that was let go moves far within one:
// what follows does not say how it swings to the accuracy of its markers.
bool leave_out_after_break(Trial& trial) {
  double first = std::numeric_limits<double>::infinity();
  for (const MeasuredEvent& event : trial.events)
    if (event.is_detachment()) first = std::min(first, event.time);
  bool any = false;
  for (Samples* samples : {&trial.markers, &trial.force, &trial.wrench})
    for (int i = 0; i < samples->size(); ++i) {
      const double interval =
          // Of its neighbours, since tables have clocks of their own.
          samples->time[std::min(i + 1, samples->size() - 1)] - samples->time[std::max(i - 1, 0)];
      // The interval holds two samples, so this is one and a half before: when it came off is known
      // to a sample.
      if (samples->time[i] < first - 0.75 * interval) continue;
      samples->value.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      any = true;
    }
  return any;
}

}  // namespace

Admission admit(const Experiment& experiment) {
  Admission admission;
  // A copy, since the caller may want to show what was measured.
  admission.experiment = experiment;
  // First: outliers and gaps of another trial's table say nothing about this one.
  admission.contradictions = contradictions(experiment);
  if (!admission.contradictions.empty()) {
    admission.refusal = sentence(admission.contradictions);
    return admission;
  }
  for (Trial& trial : admission.experiment.trials) {
    // Before anything is left out: what was never there is told apart from that.
    const int before = count_finite(trial.markers.value);
    admission.missing += static_cast<int>(trial.markers.value.size()) - before;
    if (leave_out_after_break(trial))
      admission.remarks.push_back("Trial " + in_quotes(trial.name) +
                                  " is compared until a fruit comes off");
    if (trial.is_static) {
      admission.samples += count_finite(trial.markers.value) + count_finite(trial.force.value) +
                           count_finite(trial.wrench.value);
      continue;  // its rows are no neighbours in time
    }
    // Before outliers: two markers that exchange places are outlying twice.
    admission.swaps += put_back(exchanges_in(trial.markers.value), trial.markers.value);
    const double scatter = scatter_of_markers(trial);
    // A program that smooths leaves no scatter. What the file states then stands for the
    // instrument.
    const double noise = std::min(scatter, experiment.noise.position_std.value_or(scatter));
    // A gap that was filled has no noise to whiten, and counts as so many samples that agree with
    // any smooth model. So it is taken out before the noise is read.
    if (noise > least_noise)
      for (Eigen::Index c = 0; c + 3 <= trial.markers.value.cols(); c += 3)
        admission.filled += take_out_filled(trial.markers.value.middleCols(c, 3), noise);
    for (Samples* samples : {&trial.markers, &trial.force, &trial.wrench}) {
      // For each table by its own times.
      const std::vector<char> spared = beside_jumps(trial, samples->time);
      for (Eigen::Index c = 0; c < samples->value.cols(); ++c) {
        admission.samples += count_finite(samples->value.col(c));
        // A force that is exactly zero after the release is what the format asks for.
        if (samples == &trial.markers) admission.stuck += take_out_stuck(samples->value.col(c));
      }
      for (Eigen::Index c = 0; c + 3 <= samples->value.cols(); c += 3) {
        // Counted by points, as an outlier takes all three numbers with it.
        admission.points += count_points(samples->value.middleCols(c, 3));
        admission.outliers += take_out_outliers(samples->value.middleCols(c, 3), spared);
      }
    }
    // One trial without anything to compare with is a mistake in the folder, not a trial less.
    if (count_finite(trial.markers.value) + count_finite(trial.force.value) +
            count_finite(trial.wrench.value) ==
        0)
      admission.refusal = named_trial(trial.name) + " holds no usable sample";
  }
  const auto remark = [&](int count, const std::string& what) {
    if (count > 0) admission.remarks.push_back(std::to_string(count) + " " + what);
  };
  remark(admission.missing, "cells are empty");
  remark(admission.outliers, "samples are far from their neighbours and were left out");
  remark(admission.stuck, "samples repeat one value and were left out");
  remark(admission.filled,
         "samples lie on smooth lines without noise, as a program fills gaps, and "
         "were left out");
  remark(admission.swaps, "samples had two markers' labels exchanged, which was put back");
  if (admission.samples == 0) admission.refusal = "there is no sample at all";
  // A scatter that is taken from neighbours means nothing when so many of them are off.
  if (admission.outlier_fraction() > 0.2)
    admission.refusal = "every fifth sample is far from its neighbours";
  return admission;
}

// Each contradiction has a file of its own. A refusal is about the whole.
void add_refusal(Diagnostics& diagnostics, const Admission& admission) {
  if (!admission.contradictions.empty())
    add_to(diagnostics, admission.experiment, admission.contradictions);
  else if (!admission.refusal.empty())
    diagnostics.error({(admission.experiment.folder / "experiment.yaml").string(), 0, 0},
                      admission.refusal);
}

}  // namespace pedicel::discrepancy
