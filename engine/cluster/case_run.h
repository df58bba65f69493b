#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "engine/cluster/case_record.h"
#include "engine/cluster/job_list.h"

namespace pedicel::cluster {

/// Tells whether the files that a case reads are still those of the task file.
class InputCheck {
 public:
  explicit InputCheck(const TaskHead& head) : head_(head) {}
  /// What is wrong with the first one that is not; empty: they are. A file whose size and time stay
  /// is read once.
  std::string fault();

 private:
  struct Seen {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time;
    std::string sha256;
  };
  const TaskHead& head_;
  std::map<std::string, Seen> seen_;
};

struct CaseRunOptions {
  RunFolder folder;
  std::filesystem::path scratch;  ///< where results are made first; empty: in the run's own folder
  std::string instruction_set;    ///< that this program solves rods with here
};

/// Runs one case as a program of its own, writes its results aside, and renames them when they are
/// whole and on disk. What failed leaves a record of why (RunFolder::failure) and nothing else.
/// Where the results are there already the record of them comes back, and nothing is done. Throws
/// Stopped where it was stopped.
CaseRecord run_case(const TaskHead& head, const Case& one, InputCheck& inputs,
                    const CaseRunOptions& options);

/// The record of results that are whole; nothing where there are none.
std::optional<CaseRecord> finished(const RunFolder& folder, const std::string& id);

}  // namespace pedicel::cluster
