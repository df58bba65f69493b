#pragma once

#include <vector>

#include "engine/io/key.h"

namespace pedicel::discrepancy {

/// The keys of all maps of an experiment.yaml whose model is a scene. They live as long as the
/// program.
std::vector<const io::KeyList*> scene_experiment_keys();

}  // namespace pedicel::discrepancy
