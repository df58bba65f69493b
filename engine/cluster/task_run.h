#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/cluster/task_file.h"

namespace pedicel::cluster {

/// What a program says of itself to the tasks that it does.
struct ProgramAbout {
  std::string version, git_hash;
  /// The instruction set that rods are solved with here where `asked` is asked for; empty: the
  /// best. Throws UsageError where this processor does not have it.
  std::function<std::string(const std::string& asked)> instruction_set;

  ProgramIdentity identity() const;
};

/// One task: does the cases of a block, those that are not done yet, one after the other. Leaves a
/// summary of the block when all are done. Exit code 0; 1 where a case failed, with a line on
/// standard error for each. Throws InvalidFile, UsageError, Stopped.
int run_task(const std::filesystem::path& folder, int block, const std::filesystem::path& scratch,
             const ProgramAbout& about);

/// `PROGRAM cluster task FOLDER BLOCK [--scratch DIR]`, for programs whose only use of `cluster` it
/// is; nothing where the arguments are others.
std::optional<int> run_as_task(int argc, char** argv, const ProgramAbout& about);

}  // namespace pedicel::cluster
