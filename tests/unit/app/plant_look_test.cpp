// What a plant looks like is said by its file, and by nothing else.
#include <gtest/gtest.h>

#include <algorithm>

#include "app/draw/scene_view.h"
#include "engine/io/atomic_file.h"
#include "engine/world/scene_reader.h"
#include "plugins/simulation/simulation.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {
namespace {

class PlantLooks : public testing::Test {
 protected:
  /// The colours of a picture of one fruit on a stem, whose file has these lines.
  render::DrawList drawn(const std::string& lines, const std::string& in_scene = "") {
    io::write_file_atomically(folder_ / "p.plant.yaml", R"(format: pedicel-plant
version: 1
name: p
sampling: {connect: 0.01, distance: 0.05}
root: [0, 0, 0]
curves:
  - {name: stem, points: [[0, 0, 0], [0, 0, 0.3]], radius: 0.004}
fruits:
  - {name: fruit, curve: stem, at: 1.0, radius: 0.01, density: 900}
)" + lines);
    io::write_file_atomically(folder_ / "p.scene.yaml",
                              "format: pedicel-scene\nversion: 1\npurpose: a look\nsee: a fruit\n"
                              "duration: 0.1\nplants:\n  - {name: p, file: p.plant.yaml" +
                                  in_scene + "}\n");
    Diagnostics diagnostics;
    const auto scene = world::read_scene(folder_ / "p.scene.yaml", diagnostics);
    if (!scene) throw InvalidFile(diagnostics);
    const simulation::Simulation simulation(*scene, {});
    SceneView view(simulation);
    Frame frame;
    view.fill(frame, false);
    return frame.list;
  }

  /// Materials differ in roughness, which no shade changes.
  static bool has_skin(const render::DrawList& list, const render::Shading& skin) {
    return std::ranges::any_of(list.spheres, [&](const render::Sphere& sphere) {
      return sphere.material.roughness == skin.roughness;
    });
  }

  const TemporaryFolder folder_;
  const std::string green_ =
      "material: {youngs_modulus: 2.0e+8, poisson_ratio: 0.35, density: 800,"
      " damping_time: 0.02}\n";
  const std::string stiff_ =
      "material: {youngs_modulus: 9.0e+8, poisson_ratio: 0.35, density: 800,"
      " damping_time: 0.02}\n";
};

TEST_F(PlantLooks, AStiffTomatoStaysATomato) {
  EXPECT_TRUE(has_skin(drawn(green_), render::shadings::tomato));
  EXPECT_TRUE(has_skin(drawn(stiff_), render::shadings::tomato));
  EXPECT_TRUE(has_skin(drawn(green_, ", set: {material.youngs_modulus: 5.0e+9}"),
                       render::shadings::tomato));
}

TEST_F(PlantLooks, ASoftAppleStaysAnApple) {
  EXPECT_TRUE(has_skin(drawn(green_ + "look: apple\n"), render::shadings::apple));
  EXPECT_FALSE(has_skin(drawn(green_ + "look: apple\n"), render::shadings::tomato));
}

}  // namespace
}  // namespace pedicel::app
