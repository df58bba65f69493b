#pragma once

#include "engine/io/described_map.h"
#include "plugins/effects/registry/effect_definition.h"

namespace pedicel::plant {

/// Reads `where: {curve, at}`-like keys out of a map that holds them directly. `whole_curve`: the
/// curve alone counts, and `at` may be left out.
CurvePlace read_place(io::YamlMap& map, bool whole_curve = false);

/// The keys of a place on a curve, and a place out of a map that has them among its own.
const io::KeyList& place_keys();
CurvePlace read_place(io::DescribedMap& map);

/// Reads the parameters of an effect out of its map.
void read_effect_parameters(io::YamlMap& map,
                            const std::vector<effects::EffectParameter>& parameters,
                            Effect& effect);

/// Reads one entry of an `effects:` list of a file of that kind, with its name and its parameters
/// checked against the effect's definition. Faults go to the node's diagnostics.
Effect read_effect(const io::YamlNode& node, effects::EffectFile file);

}  // namespace pedicel::plant
