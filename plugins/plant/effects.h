#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/yaml.h"
#include "plant/plant_file.h"

namespace pedicel::plant {

/// Which file an effect belongs to: what happens at the sensor or the grip stands in an experiment.
enum class EffectHome { plant, experiment };

struct EffectParameter {
  std::string name;
  io::Bounds bounds;
  int size = 1;  ///< numbers it has; 0: it is a word
  bool required = true;
  std::vector<std::string> words = {};  ///< that it may be; empty: any
};

/// One known effect: section 3 of the formats as a table.
struct EffectKind {
  std::string name;
  EffectHome home = EffectHome::plant;
  bool needs_place = false;
  bool simulated = false;  ///< apply_effects() can run it
  std::vector<EffectParameter> parameters;
};

const std::vector<EffectKind>& known_effects();
const EffectKind* find_effect(const std::string& name);

/// Reads `where: {curve, at}`-like keys out of a map that holds them directly.
CurvePlace read_place(io::YamlMap& map);

/// Reads one entry of an `effects:` list of a file of kind `home`, with its names and parameters
/// checked. Faults go to the node's diagnostics.
Effect read_effect(const io::YamlNode& node, EffectHome home);

}  // namespace pedicel::plant
