#pragma once

#include <Eigen/Dense>
#include <vector>

#include "plugins/discrepancy/pick/pick_record.h"

namespace pedicel::discrepancy {

/// A record made ready to be judged: without its zero, missing rows and lone spikes, at most 2 kHz.
class PickForce {
 public:
  /// `rest`: s at the start of the record whose median is the zero.
  PickForce(const PickRecord& record, double rest);

  int size() const { return static_cast<int>(time_.size()); }
  int axes() const { return static_cast<int>(force_.cols()); }
  double time(int i) const { return time_[static_cast<std::size_t>(i)]; }  ///< s
  Eigen::VectorXd force(int i) const { return force_.row(i); }             ///< N, above the zero
  double noise() const { return noise_; }        ///< N, standard deviation of one sample and axis
  double interval() const { return interval_; }  ///< s, median between two samples

  /// The first sample at or after a time; size() where there is none.
  int first_at(double time) const;
  /// Mean over [from, to), N; of the sample nearest to it where it holds none.
  Eigen::VectorXd mean(double from, double to) const;
  /// Whether samples lie in at least half of [from, to), s.
  bool covers(double from, double to) const;

 private:
  void take_rows(const PickRecord& record);
  void take_spikes_out();
  void thin();

  std::vector<double> time_;
  Eigen::MatrixXd force_;  ///< samples x axes
  Eigen::MatrixXd sums_;   ///< of the samples before each
  double noise_ = 0.0, interval_ = 0.0;
};

/// Middle value; 0 of none.
double middle_of(std::vector<double> values);

}  // namespace pedicel::discrepancy
