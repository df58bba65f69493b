#include "session/plant_import.h"

#include "plant/mtg_reader.h"

namespace pedicel::app {

bool is_plant_file(const std::filesystem::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

std::optional<plant::PlantFile> read_plant(const std::filesystem::path& path,
                                           Diagnostics& diagnostics) {
  if (is_plant_file(path)) return plant::read_plant_file(path, diagnostics);
  if (path.extension() == ".csv") {
    plant::MtgOptions options;
    options.keeps_thin = true;  // a fruit's stalk
    return plant::read_skeleton_csv(path, options, diagnostics);
  }
  if (path.extension() == ".mtg") return plant::read_mtg(path, {}, diagnostics);
  diagnostics.error({path.string(), 0, 0},
                    "cannot tell what this is, expected *.scene.yaml, *.plant.yaml, *.csv (a "
                    "skeleton) or *.mtg");
  return std::nullopt;
}

}  // namespace pedicel::app
