#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "plugins/simulation/channels.h"

namespace pedicel::app {

/// Loads of an organ at a time.
struct OrganLoad {
  double time = 0.0;    ///< s
  double strain = 0.0;  ///< 1, largest at a surface of the organ
  double force = 0.0;   ///< N, largest in its joints
  double moment = 0.0;  ///< N m
};

/// The quantities of a run over its time, and the loads of one organ: what plots show. Written by
/// the simulation's thread, read by any; a row is short, so nobody waits long.
class RunLog {
 public:
  static constexpr int most_rows = 6000;
  static constexpr double rate = 100.0;  ///< Hz of simulated time

  /// Begins anew with another simulation, or another run of one; it must live while rows are added.
  void begin(const simulation::Simulation& simulation);
  /// A row where one is due.
  void observe(const simulation::Simulation& simulation);
  void watch(std::string organ);

  std::vector<std::string> names() const;
  struct Series {
    std::vector<double> time, value;
  };
  /// What is kept of a quantity; empty for an unknown one.
  Series series(const std::string& name) const;
  /// Its newest value, NaN where there is none.
  double last(const std::string& name) const;
  std::vector<OrganLoad> loads() const;

 private:
  mutable std::mutex mutex_;
  std::vector<simulation::Channel> channels_;
  std::deque<std::vector<double>> rows_;  // time first
  std::deque<OrganLoad> loads_;
  std::string organ_;
  long last_due_ = -1;
};

}  // namespace pedicel::app
