#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/csv.h"
#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::simulation {

/// What two organs of different plants do to each other.
struct OrganContact {
  std::string organ, other;     ///< "bush/stem", "truss/fruit_3"
  double normal = 0.0;          ///< N, sum of the normal forces' sizes
  double tangential = 0.0;      ///< N, likewise
  Vec3 force_W = Vec3::Zero();  ///< N, on `organ`
};

/// Of the last step, each pair once, in the order of the plants. Empty where plants do not touch
/// each other.
std::vector<OrganContact> organ_contacts(const cosserat::RodSystem& rods);

/// Writes them to a table, one row a pair, at a fixed rate of simulated time.
class OrganContactLog {
 public:
  /// `rate` in Hz. Throws io::WriteError.
  OrganContactLog(const std::filesystem::path& file, double rate);
  /// At the end of a step.
  void observe(double time, const cosserat::RodSystem& rods);

 private:
  io::CsvWriter table_;
  double rate_;
  long last_due_ = -1;
};

}  // namespace pedicel::simulation
