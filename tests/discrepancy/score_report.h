#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "tests/discrepancy/scoring.h"

namespace pedicel::hidden {

/// The scores in a file of one line a case, in the order of their numbers; of a case that stands
/// there twice the last one. Lines that are not whole (a stop in the middle of writing) are left
/// out. No file: no scores.
std::vector<Score> read_scores(const std::filesystem::path& file, std::uint64_t seed);

/// Appends one line. Throws io::WriteError.
void append_score(const std::filesystem::path& file, const Score& score);

/// Writes table.md, table.csv, confusion.md, confusion.csv and report.html into `folder`. Throws
/// io::WriteError.
void write_score_report(const std::filesystem::path& folder, const std::vector<Score>& scores,
                        std::uint64_t seed);

}  // namespace pedicel::hidden
