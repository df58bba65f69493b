#pragma once

#include <string>

#include "engine/cluster/task_file.h"

namespace pedicel::cluster {

/// What is told of a case beside its results: what it was done with, where, and how it ended.
struct CaseRecord {
  std::string id, name;
  ProgramIdentity program;
  std::string instruction_set;  ///< that the rods were solved with: "AVX2"
  std::string math;             ///< math_level()
  std::string host, job;        ///< job: "123_4" of Slurm; empty: none
  int restarts = 0;             ///< SLURM_RESTART_COUNT
  int exit_code = 0;
  double seconds = 0.0;  ///< s, of wall time, with everything around it
  std::string ended;     ///< "2026-11-27T14:31:07Z"
  std::string reason;    ///< why it failed; empty: it did not
};

/// One JSON object, on one line.
std::string to_json(const CaseRecord& record);
/// Throws InvalidFile where it is none.
CaseRecord parse_record(const std::string& text, const std::string& file);

}  // namespace pedicel::cluster
