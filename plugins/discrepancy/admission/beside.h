#pragma once

#include <string>
#include <vector>

#include "plugins/discrepancy/admission/following.h"

namespace pedicel::discrepancy {

/// Something that is done to the plant, and the marker beside it, which has to go along. Keeps a
/// reference to what the view refers to.
class Beside {
 public:
  /// Of all drives that have a marker near to them which was seen often enough.
  static std::vector<Beside> all_of(const TrialView& view);

  const TrialView& view() const { return *view_; }
  const Drive& drive() const { return drive_; }
  const Track& track() const { return track_; }
  double noise() const { return noise_; }  ///< m
  const std::string& marker() const;       ///< its name
  std::string what() const;                ///< "hold.csv", "the load"

  Following follow(const ClockReading& reading = {}) const;
  /// 0 to 1: the share of the marker's motion that goes along with the drive; 0 where it goes
  /// another way, farther than any neighbour, or hardly at all.
  double explained(const ClockReading& reading = {}) const;
  double explained_by(const Drive& other) const;
  /// rms of the whole drive about its mean, as if all of it had been seen.
  double whole() const { return whole_; }

 private:
  Beside(const TrialView& view, Drive drive, int marker, double noise);
  double valid(const Following& f, const Drive& drive) const;

  const TrialView* view_;
  Drive drive_;
  double noise_;
  Track track_;
  double whole_ = 0.0;
};

}  // namespace pedicel::discrepancy
