#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/yaml_piece.h"
#include "plugins/plant/plant_file.h"

namespace pedicel::app {

/// Whether a path is an experiment's folder or its experiment.yaml.
bool is_experiment(const std::filesystem::path& path);

/// A list of effects as `set effects` takes it, and back. Faults go to `diagnostics`.
std::string effects_text(const std::vector<plant::Effect>& effects);
std::optional<std::vector<plant::Effect>> parse_effects(const std::string& text,
                                                        Diagnostics& diagnostics);

/// The same of a scene's effects, as `set scene effects` takes them: what its file says, and more.
std::string scene_effects_text(const std::vector<io::YamlPiece>& pieces,
                               const std::vector<plant::Effect>& more = {});
std::vector<io::YamlPiece> parse_scene_effects(const std::string& text, Diagnostics& diagnostics);

}  // namespace pedicel::app
