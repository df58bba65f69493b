#pragma once

#include <vector>

#include "engine/io/key.h"

namespace pedicel::plant {

/// The keys of each map of a plant file, as the lists of plant_model.h describe those that edits
/// and the window know, too. They live as long as the program.
const io::KeyList& plant_list();
const io::KeyList& sampling_list();
const io::KeyList& material_list();
const io::KeyList& known_to_list();
const io::KeyList& curve_list();
const io::KeyList& section_list();
const io::KeyList& support_list();
const io::KeyList& fruit_list();
const io::KeyList& detach_list();
const io::KeyList& leaf_list();
const io::KeyList& mass_list();

/// All of them, and that of a place.
std::vector<const io::KeyList*> plant_file_keys();

}  // namespace pedicel::plant
