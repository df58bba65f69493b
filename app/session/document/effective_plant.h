#pragma once

#include <string>

#include "plugins/plant/plant_file.h"

namespace pedicel::app {

struct Document;

/// A plant of the document as it is simulated: its file, with what the scene's `set:` and the
/// settings make of it. Throws UsageError for a plant that is not there or cannot be edited.
plant::PlantFile effective_plant(const Document& document, const std::string& plant);

/// Whose word goes before the plant file's for a key such as "detach.stretch".
enum class SetBy {
  file,     ///< nobody's
  scene,    ///< the scene file's `set:`
  session,  ///< a setting of the document: `keep setting` writes it into the plant
};
struct PlantSetting {
  SetBy by = SetBy::file;
  std::string key;  ///< session: the setting, "plants.tomato.detach.stretch" or "detach.stretch"
};
PlantSetting who_sets(const Document& document, const std::string& plant, const std::string& key);

/// Writes one setting into the plants that it is about, and takes it away. Throws UsageError where
/// it is not set, or no plant's.
void keep_setting(Document& document, const std::string& key);

}  // namespace pedicel::app
