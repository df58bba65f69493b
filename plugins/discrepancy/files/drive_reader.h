#pragma once

#include <functional>

#include "engine/io/described_map.h"
#include "plugins/discrepancy/data/experiment.h"

namespace pedicel::discrepancy {

/// Told each place on a curve that was read, to check it.
using CheckPlace = std::function<void(const plant::CurvePlace&)>;

/// Reads a trial's `drive:` with the tables of its paths, which lie in `folder`. Faults go to the
/// node's diagnostics.
void read_drives(const io::YamlNode& list, const std::filesystem::path& folder,
                 const CheckPlace& check, Trial& trial);

/// The keys of a drive, and of each kind of it beside those.
std::vector<const io::KeyList*> drive_keys();

/// That a static series says nothing of time, and that all its tables have a row for each of
/// markers.csv; a path may have a single one. `node` is the trial's.
void check_static(const io::YamlNode& node, const Trial& trial, Diagnostics& diagnostics);

}  // namespace pedicel::discrepancy
