#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "plugins/cosserat/solver/rod_system.h"

namespace pedicel::app {

inline const Vec3 bench_gravity(0, 0, -9.81);  // m/s2, W

/// What `pedicel bench` is asked to do.
struct BenchOptions {
  std::string name = "rods_2242";  ///< one of bench_names()
  int threads = 1;
  double dt = 1.0 / 240.0;    ///< s
  double duration = 2.0;      ///< s, simulated, after the warm-up; repeated if that is over soon
  bool self_contact = false;  ///< organs of one plant may touch each other
  bool accuracy = true;       ///< measure BenchAccuracy, too (some seconds)
  cosserat::RodSettings rods;
};

/// What the settings of a speed are worth.
struct BenchAccuracy {
  /// 1, relative, of the heavy cantilever's tip drop, with 20 and 40 elements.
  double cantilever_error = 0.0, cantilever_error_40 = 0.0;
  /// 1, relative, of its first frequency without gravity, 20 elements, and its numerical damping
  /// ratio. Nothing where it does not oscillate.
  std::optional<double> frequency_error, damping_ratio;
  double forest_droop = 0.0;  ///< m, mean over the forest's 228 ends, settled; -4.62 mm is right
};

/// Speed, memory and, at the same settings, accuracy: a real-time factor means nothing without its
/// errors.
struct BenchResult {
  int rods = 0;  ///< elements
  int threads = 0;
  double dt = 0.0;                ///< s
  double real_time_factor = 0.0;  ///< simulated s / wall s
  double ms_per_step_p50 = 0.0, ms_per_step_p95 = 0.0;
  double ns_per_element_step = 0.0;  ///< wall time
  double bytes_per_element = 0.0;    ///< growth of the resident memory: plants, solvers, warm
  double peak_megabytes = 0.0;       ///< MiB, of the whole process
  std::optional<BenchAccuracy> accuracy;
  std::uint64_t state_hash = 0;  ///< of the final state
};

/// The names that run_bench() knows: the forest and the tree of plant/reference_plants.h, and rows
/// of forest plants of about 1,000, 10,000 and 100,000 elements.
const std::vector<std::string>& bench_names();

/// Their plants. Throws UsageError for a name that is none of them.
std::vector<cosserat::RodModel> bench_plants(const std::string& name);
void add_bench_plant(cosserat::RodSystem& system, cosserat::RodModel model,
                     const BenchOptions& options);

/// Runs a benchmark. Throws UsageError for a name that it does not know, with the ones it does.
BenchResult run_bench(const BenchOptions& options);

/// The keys of BenchResult and BenchAccuracy as JSON, one object; null: not measured, or no number.
std::string to_json(const BenchResult& result);

/// The same for people.
std::string to_text(const BenchResult& result);

/// A state hash as it is printed, 16 digits.
std::string hexadecimal(std::uint64_t number);

}  // namespace pedicel::app
