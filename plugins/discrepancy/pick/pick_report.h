#pragma once

#include <filesystem>
#include <vector>

#include "plugins/discrepancy/pick/pick_text.h"

namespace pedicel::discrepancy {

/// One HTML page that opens by itself: a table, and a record's force with what was found in it.
/// Throws io::WriteError.
void write_pick_report(const std::filesystem::path& file, const std::vector<JudgedPick>& all,
                       const PickSettings& settings);

}  // namespace pedicel::discrepancy
