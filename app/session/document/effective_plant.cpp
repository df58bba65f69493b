#include "app/session/document/effective_plant.h"

#include <algorithm>

#include "app/session/document/document.h"
#include "app/session/document/plant_parameters.h"
#include "engine/core/check.h"
#include "plugins/simulation/plants/plant_overrides.h"

namespace pedicel::app {

namespace {

std::size_t index_of(const Document& document, const std::string& plant) {
  document.plant(plant);  // throws where there is none
  return static_cast<std::size_t>(document.plant_index(plant));
}

plant::PlantFile with(plant::PlantFile plant, const std::vector<world::Setting>& settings) {
  Diagnostics diagnostics;
  simulation::apply_plant_overrides(plant, settings, diagnostics);
  if (diagnostics.has_errors()) throw UsageError(sentences(diagnostics.all()));
  return plant;
}

bool holds(const std::vector<world::Setting>& settings, const std::string& key) {
  return std::ranges::any_of(settings, [&](const auto& one) { return one.key == key; });
}

}  // namespace

plant::PlantFile effective_plant(const Document& document, const std::string& plant) {
  const std::size_t p = index_of(document, plant);
  return with(*document.plants[p].file, scene_of(document).plants[p].set);
}

PlantSetting who_sets(const Document& document, const std::string& plant, const std::string& key) {
  // The last word counts.
  for (auto one = document.settings.rbegin(); one != document.settings.rend(); ++one)
    if (one->first == key || one->first == "plants." + plant + "." + key)
      return {SetBy::session, one->first};
  const int p = document.plant_index(plant);
  if (p >= 0 && holds(document.plants[static_cast<std::size_t>(p)].entry.set, key))
    return {SetBy::scene, {}};
  return {};
}

void keep_setting(Document& document, const std::string& key) {
  const auto held =
      std::ranges::find_if(document.settings, [&](const auto& one) { return one.first == key; });
  if (held == document.settings.end())
    throw UsageError("\"" + key + "\" is as the files say already");
  if (!is_plant_key(key))
    throw UsageError("\"" + key + "\" belongs to the scene, expected a key of a plant");
  Document alone = document;
  alone.settings = {*held};
  const world::Scene scene = scene_of(alone);
  for (std::size_t p = 0; p < document.plants.size(); ++p) {
    const DocumentPlant& one = document.plants[p];
    const std::vector<world::Setting>& all = scene.plants[p].set;
    const auto count = static_cast<std::ptrdiff_t>(one.entry.set.size());
    const std::vector<world::Setting> kept(all.begin() + count, all.end());
    if (!one.file || kept.empty()) continue;
    if (holds(one.entry.set, kept.back().key))
      throw UsageError(kept.back().key + " of " + one.entry.name +
                       " is set by the scene, expected it there");
    document.edit_plant(one.entry.name) = with(*one.file, kept);
  }
  std::erase_if(document.settings, [&](const auto& one) { return one.first == key; });
}

}  // namespace pedicel::app
