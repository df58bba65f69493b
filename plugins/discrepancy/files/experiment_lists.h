#pragma once

#include <cstddef>
#include <vector>

#include "engine/io/key.h"

/// The keys of the maps of experiment.yaml, for its reader and the manual.
namespace pedicel::discrepancy {

/// So that no folder fills the memory.
inline constexpr std::size_t most_trials = 10000, most_markers = 10000, most_cameras = 100,
                             most_wrenches = 100;

const io::KeyList& experiment_list();
const io::KeyList& marker_list();
const io::KeyList& camera_list();
const io::KeyList& wrench_list();
const io::KeyList& noise_list();
const io::KeyList& trial_list();
const io::KeyList& follows_list();
const io::KeyList& mass_list();
const io::KeyList& moved_list();

/// All of them, those of a drive included. They live as long as the program.
std::vector<const io::KeyList*> experiment_keys();

}  // namespace pedicel::discrepancy
