#include "plugins/discrepancy/log_import/log_scene.h"

#include <algorithm>

#include "engine/io/atomic_file.h"
#include "engine/io/common_folder.h"
#include "engine/robot/kinematics.h"
#include "engine/world/scene_reader.h"
#include "plugins/plant/leaf_template.h"
#include "plugins/simulation/robot_control.h"
#include "plugins/simulation/scene_plants.h"

namespace pedicel::discrepancy {

namespace {

namespace fs = std::filesystem;

void add_file(std::vector<fs::path>& files, const fs::path& file) {
  const fs::path plain = fs::weakly_canonical(file);
  if (!plain.empty() && std::ranges::find(files, plain) == files.end()) files.push_back(plain);
}

void read_robot(LogScene& out, Diagnostics& diagnostics) {
  const world::SceneRobot& robot = *out.scene.robot;
  auto description = simulation::read_robot(robot, {}, diagnostics);
  if (!description) return;
  out.robot = std::move(*description);
  out.joints = robot::KinematicModel(out.robot).joint_names();
  add_file(out.files, robot.file);
  add_file(out.files, robot.trajectory);
  for (const robot::Link& link : out.robot.links) {
    for (const robot::Collision& shape : link.collisions)
      if (!shape.geometry.mesh_file.empty()) add_file(out.files, shape.geometry.mesh_file);
    for (const robot::Visual& shape : link.visuals)
      if (!shape.geometry.mesh_file.empty()) add_file(out.files, shape.geometry.mesh_file);
  }
}

void read_plants(LogScene& out, Diagnostics& diagnostics) {
  for (simulation::PlacedPlantFile& plant : simulation::plant_files(out.scene, {}, diagnostics)) {
    add_file(out.files, plant.source);
    // What is shipped with the program is found without being carried along.
    for (const plant::PlantLeaf& leaf : plant.file.leaves)
      if (const auto found = plant::find_leaf_template(leaf.leaf_template,
                                                       {fs::absolute(plant.source).parent_path()}))
        add_file(out.files, *found);
    out.plants.push_back(std::move(plant.file));
  }
}

}  // namespace

LogScene read_log_scene(const fs::path& file) {
  Diagnostics diagnostics;
  LogScene out;
  if (auto scene = world::read_scene(file, diagnostics)) {
    out.scene = std::move(*scene);
    add_file(out.files, file);
    if (out.scene.robot)
      read_robot(out, diagnostics);
    else
      diagnostics.error({file.string()},
                        "the scene has no robot, expected one whose joints were "
                        "recorded");
    read_plants(out, diagnostics);
    if (out.scene.plants.empty())
      diagnostics.error({file.string()}, "the scene has no plants, expected at least one");
  }
  if (diagnostics.has_errors()) throw InvalidFile(diagnostics);
  return out;
}

fs::path copy_scene(const LogScene& scene, const fs::path& folder) {
  const fs::path from = io::common_folder(scene.files);
  for (const fs::path& file : scene.files) {
    const fs::path to = folder / file.lexically_relative(from);
    std::error_code fault;
    fs::create_directories(to.parent_path(), fault);
    if (!fault) fs::copy_file(file, to, fs::copy_options::overwrite_existing, fault);
    if (fault) throw io::WriteError(to.string() + ": cannot be written: " + fault.message());
  }
  return scene.files.front().lexically_relative(from);
}

}  // namespace pedicel::discrepancy
