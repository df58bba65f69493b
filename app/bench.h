#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cosserat/rod_solver.h"

namespace pedicel::app {

/// What `pedicel bench` is asked to do.
struct BenchOptions {
  std::string name = "rods_2242";
  int threads = 1;
  double dt = 1.0 / 240.0;  ///< s
  double duration = 2.0;    ///< s, simulated, after the warm-up
  cosserat::RodSettings rods;
};

/// Speed and, at the same settings, accuracy: a real-time factor means nothing without its errors.
struct BenchResult {
  int rods = 0;  ///< elements
  int threads = 0;
  double dt = 0.0;                ///< s
  double real_time_factor = 0.0;  ///< simulated s / wall s
  double ms_per_step_p50 = 0.0, ms_per_step_p95 = 0.0;
  double cantilever_error = 0.0;  ///< 1, relative, of the heavy cantilever's tip drop, 20 elements
  double frequency_error = 0.0;   ///< 1, relative, of its first frequency without gravity
  std::uint64_t state_hash = 0;   ///< of the final state
};

/// The names that run_bench() knows.
const std::vector<std::string>& bench_names();

/// Runs a benchmark. Throws UsageError for a name that it does not know, with the ones it does.
BenchResult run_bench(const BenchOptions& options);

/// The keys of BenchResult as JSON, one object.
std::string to_json(const BenchResult& result);

/// The same for people.
std::string to_text(const BenchResult& result);

}  // namespace pedicel::app
