#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/cluster/case_record.h"
#include "engine/cluster/job_list.h"

namespace pedicel::cluster {

/// What is there of a run.
struct Survey {
  std::vector<std::optional<CaseRecord>> records;  ///< of every case that is done
  std::vector<int> missing;                        ///< numbers of the others
  std::vector<CaseRecord> failures;                ///< of those that said why
  double seconds = 0.0;                            ///< s, wall time of all that are done

  int done() const { return static_cast<int>(records.size() - missing.size()); }
};

/// Looks at a run's folder, again and again. What is done stays done and is read once, a block at
/// a time, so that a look costs little whatever the run's size.
class Surveyor {
 public:
  Surveyor(RunFolder folder, const TaskFile& tasks);

  /// `thorough`: also the cases of blocks under way, however many.
  Survey look(bool thorough);

 private:
  void take_blocks();
  void take_cases(bool thorough);

  RunFolder folder_;
  const TaskFile& tasks_;
  std::vector<int> first_;  // case of each block, and one more
  std::set<int> blocks_;    // that are taken
  std::vector<std::optional<CaseRecord>> records_;
};

/// Why the results of a run are no set: a sentence that names the cases and their nodes; empty:
/// they are. Results of different programs or instruction sets differ in their last bits.
std::string mixture(const Survey& survey);

/// The blocks of the missing cases, sorted.
std::vector<int> missing_blocks(const Survey& survey, const TaskFile& tasks);

}  // namespace pedicel::cluster
