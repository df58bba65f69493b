#pragma once

#include <vector>

#include "engine/io/key.h"

namespace pedicel::discrepancy {

/// The keys of all maps of experiment.yaml, drives included. They live as long as the program.
std::vector<const io::KeyList*> experiment_keys();

}  // namespace pedicel::discrepancy
