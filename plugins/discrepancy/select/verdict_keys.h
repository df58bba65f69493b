#pragma once

#include <vector>

#include "engine/io/key.h"

namespace pedicel::discrepancy {

/// The keys of all maps of verdict.json. They live as long as the program.
std::vector<const io::KeyList*> verdict_keys();

}  // namespace pedicel::discrepancy
