#include "plugins/discrepancy/pick/pick_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pedicel::discrepancy {

namespace {

constexpr double finest = 0.5e-3;  // s between samples: faster records are averaged to that

// Without a branch that depends on order, as it runs over every sample.
double middle_of_three(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

/// Standard deviation of one sample: half the mean square of the steps between neighbours, which
/// slow changes do not enter. At least what the sensor's own steps round off.
double noise_of(const Eigen::MatrixXd& force, int count) {
  // A difference of two samples has twice the square of one.
  double squares = 0.0, least = std::numeric_limits<double>::infinity();
  int steps = 0;
  for (Eigen::Index axis = 0; axis < force.cols(); ++axis)
    for (int i = 1; i < force.rows(); ++i) {
      const double step = std::abs(force(i, axis) - force(i - 1, axis));
      // Of the whole record: while nothing moves a coarse sensor may not step at all.
      if (step > 0.0) least = std::min(least, step);
      // At rest only, since a pull has steps of its own.
      if (i < count) squares += step * step, ++steps;
    }
  // A value anywhere within a step of the sensor has a variance of a twelfth of its square.
  const double rounding = std::isfinite(least) ? least / std::sqrt(12.0) : 0.0;
  return std::max(rounding, steps > 0 ? std::sqrt(0.5 * squares / steps) : 0.0);
}

}  // namespace

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  // The middle one needs no order of the others.
  std::ranges::nth_element(values, middle);
  return *middle;
}

PickForce::PickForce(const PickRecord& record, double rest) {
  take_rows(record);
  if (time_.empty()) return;
  // Each record has its own zero: the weight of a hand, and what a sensor drifts by. At least one
  // sample: a record without any rest begins at its zero, or nothing could be said at all.
  const int resting = std::max(1, first_at(time_.front() + rest));
  for (Eigen::Index axis = 0; axis < force_.cols(); ++axis) {
    const auto start = force_.col(axis).head(resting);
    force_.col(axis).array() -= middle_of({start.begin(), start.end()});
  }
  // Before anything is smoothed, or it would be too small.
  noise_ = noise_of(force_, std::max(resting, 2));
  take_spikes_out();
  thin();
  std::vector<double> steps;
  for (int i = 1; i < size(); ++i) steps.push_back(time(i) - time(i - 1));
  // The usual one: gaps must not make it longer.
  interval_ = middle_of(steps);
  // Sums from the start give any mean by one difference. The search takes two a sample.
  sums_ = Eigen::MatrixXd::Zero(size() + 1, force_.cols());
  for (int i = 0; i < size(); ++i) sums_.row(i + 1) = sums_.row(i) + force_.row(i);
}

void PickForce::take_rows(const PickRecord& record) {
  force_.resize(record.force.rows(), record.force.cols());
  for (Eigen::Index i = 0; i < record.force.rows(); ++i) {
    // A sample without one of its axes has no direction.
    if (!record.force.row(i).allFinite()) continue;
    force_.row(static_cast<Eigen::Index>(time_.size())) = record.force.row(i);
    time_.push_back(record.time[static_cast<std::size_t>(i)]);
  }
  force_.conservativeResize(size(), Eigen::NoChange);
}

// A sample apart from both its neighbours is no force. An edge stays where it is.
void PickForce::take_spikes_out() {
  // From a copy, or a spike that was taken out would stand for its neighbour.
  const Eigen::MatrixXd raw = force_;
  for (Eigen::Index axis = 0; axis < raw.cols(); ++axis)
    for (Eigen::Index i = 1; i + 1 < raw.rows(); ++i)
      force_(i, axis) = middle_of_three(raw(i - 1, axis), raw(i, axis), raw(i + 1, axis));
}

void PickForce::thin() {
  int kept = 0;
  for (int i = 0; i < size();) {
    int end = i + 1;
    // Breaks take milliseconds. What a record has beyond that is noise and time.
    while (end < size() && time(end) - time(i) < finest) ++end;
    // About the first of them, so that times on a clock since 1970 lose no digits in the sum.
    double sum = 0.0;
    for (int j = i; j < end; ++j) sum += time(j) - time(i);
    // The mean time of a mean force, or edges would come late by half of it.
    const double middle = time(i) + sum / (end - i);
    // Averaged and not picked: dropping samples would throw away what they know of the noise.
    const Eigen::RowVectorXd mean = force_.middleRows(i, end - i).colwise().mean();
    time_[static_cast<std::size_t>(kept)] = middle;
    force_.row(kept++) = mean;
    i = end;
  }
  // Means of several samples have less noise.
  if (kept < size()) noise_ *= std::sqrt(static_cast<double>(kept) / size());
  time_.resize(static_cast<std::size_t>(kept));
  force_.conservativeResize(kept, Eigen::NoChange);
}

int PickForce::first_at(double time) const {
  return static_cast<int>(std::ranges::lower_bound(time_, time) - time_.begin());
}

Eigen::VectorXd PickForce::mean(double from, double to) const {
  const int first = first_at(from), end = first_at(to);
  // Sums from the start lose digits over long records, but forces have few.
  if (end > first) return (sums_.row(end) - sums_.row(first)).transpose() / (end - first);
  // A stretch between two samples: the next one stands for it.
  return force(std::clamp(first, 0, size() - 1));
}

bool PickForce::covers(double from, double to) const {
  const int first = first_at(from), end = first_at(to);
  // By time and not by count, because rates differ and rows are missing in places.
  const double seen = end > first ? time(end - 1) - time(first) + interval_ : 0.0;
  // Half of it seen is a level: slow records have few samples in one.
  return seen >= 0.5 * (to - from);
}

}  // namespace pedicel::discrepancy
