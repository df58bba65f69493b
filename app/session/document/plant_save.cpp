#include "app/session/document/plant_save.h"

#include "engine/core/check.h"
#include "engine/io/yaml_merge.h"

namespace pedicel::app {

namespace {

std::optional<plant::PlantFile> parsed(const std::string& text) {
  Diagnostics diagnostics;
  return plant::parse_plant(text, "plant", diagnostics);
}

}  // namespace

// A value that an anchor is on changes what its aliases say, too: those are set back one by one.
std::string changed_plant_text(const std::string& text, const plant::PlantFile& plant,
                               bool& keeps) {
  constexpr int rounds = 3;
  keeps = true;
  try {
    std::string changed = text;
    for (int round = 0; round < rounds; ++round) {
      const auto now = parsed(changed);
      if (now && *now == plant) return changed;
      if (!now) break;
      changed = io::merge_yaml(changed, plant::plant_text(*now), plant::plant_text(plant));
    }
    const auto last = parsed(changed);
    if (last && *last == plant) return changed;
  } catch (const UsageError&) {
    // below
  }
  keeps = false;
  return plant::plant_text(plant);
}

}  // namespace pedicel::app
