#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "tests/discrepancy/scoring.h"

namespace pedicel::hidden {

struct CaseRunOptions {
  std::filesystem::path folder;  ///< the experiment is written here, as `case_NNNN`
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;
};

/// A case from the order to its score.
struct CaseRun {
  HiddenCase hidden;
  discrepancy::Verdict verdict;
  Score score;
  /// What was hidden, what the diagnosis did step by step, and what it said.
  std::string notes;
};

/// Makes the case, writes it as an experiment folder, reads that back and diagnoses it: what is
/// hidden reaches the diagnosis through the files alone. A fault of the diagnosis becomes a score
/// with its `fault`. Throws io::WriteError.
CaseRun run_case(std::uint64_t seed, const CaseOrder& order, const CaseRunOptions& options);

}  // namespace pedicel::hidden
