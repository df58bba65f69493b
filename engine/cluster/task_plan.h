#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/cluster/task_file.h"
#include "engine/cluster/task_run.h"

namespace pedicel::cluster {

struct PlannedCase {
  std::string name;                    ///< "sweep_detach.stretch=0.1"
  std::vector<std::string> arguments;  ///< "--part=1"
};

/// What a verb wants to have done as tasks.
struct Plan {
  std::string verb;
  std::vector<std::string> common;  ///< first words of each case's command; "{out}" is its folder
  std::vector<std::string> again;   ///< the whole call, to take the run up with
  std::vector<PlannedCase> cases;
  std::vector<std::filesystem::path> inputs;  ///< files that the cases read
  std::vector<int> results{0};                ///< exit codes that are results
  std::string instruction_set;                ///< empty: the best of this machine
  int threads = 1;                            ///< of a case
};

/// The task file of a plan, with one case a block: every input read, every case named. Throws
/// InvalidFile for an input that cannot be read.
TaskFile tasks_of(const Plan& plan, const ProgramAbout& about);

/// Puts as many cases into a block as take `block_seconds`, where one takes `case_seconds`.
void make_blocks(TaskFile& tasks, double block_seconds, double case_seconds);

/// Whether both are about the same cases.
bool same_cases(const TaskFile& a, const TaskFile& b);

}  // namespace pedicel::cluster
