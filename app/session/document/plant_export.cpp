#include "app/session/document/plant_export.h"

#include "engine/core/check.h"
#include "engine/io/atomic_file.h"
#include "plugins/plant/plant_export.h"

namespace pedicel::app {

void write_plant_as(const std::filesystem::path& path, const plant::PlantFile& plant) {
  const std::string ending = path.extension().string();
  std::string text;
  if (ending == ".yaml" || ending == ".yml")
    text = plant::plant_text(plant);
  else if (ending == ".csv")
    text = plant::skeleton_text(plant);
  else if (ending == ".obj")
    text = plant::obj_text(plant::tube_mesh(plant), plant.name);
  else if (ending == ".ply")
    text = plant::ply_text(plant::tube_mesh(plant));
  else
    throw UsageError("\"" + path.string() +
                     "\", expected a name ending in .plant.yaml, .csv, "
                     ".obj or .ply");
  io::write_file_atomically(path, text);
}

}  // namespace pedicel::app
