#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>

#include "engine/world/scene_reader.h"
#include "plugins/simulation/simulation.h"
#include "tests/support/temporary_folder.h"

namespace pedicel::app {

/// A scene from text, with the files that it names beside it.
class SceneCase {
 public:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  std::unique_ptr<simulation::Simulation> simulation(const std::string& scene) const {
    write(
        "case.scene.yaml",
        "format: pedicel-scene\nversion: 1\nname: case\npurpose: test\nsee: test\nduration: 11\n" +
            scene);
    Diagnostics diagnostics;
    const auto read = world::read_scene(folder_ / "case.scene.yaml", diagnostics);
    if (!read) throw InvalidFile(diagnostics);
    return std::make_unique<simulation::Simulation>(*read, simulation::SimulationOptions{});
  }

 private:
  TemporaryFolder folder_;
};

/// One straight stem as a plant file: from `from` to `to`, clamped at `from`; density in kg/m3,
/// distance of its nodes in m.
inline std::string stem_file(const std::string& from, const std::string& to, double radius,
                             double modulus, const std::string& more = "", int density = 700,
                             const std::string& distance = "0.02") {
  return "format: pedicel-plant\nversion: 1\nname: stem\nshape: drawn\nmaterial: "
         "{youngs_modulus: " +
         std::to_string(modulus) + ", poisson_ratio: 0.35, density: " + std::to_string(density) +
         ", damping_time: 0.01}\nsampling: {connect: 0.006, distance: " + distance +
         "}\nroot: " + from + "\ncurves:\n  - {name: stem, points: [" + from + ", " + to +
         "], radius: " + std::to_string(radius) + "}\n" + more;
}

/// A slide of mass `mass` (kg) along `axis` with a box of 40 mm, its middle at the origin for q =
/// 0.
inline std::string slider_urdf(double mass, const std::string& axis, double effort = 0.0) {
  const std::string inertia = std::to_string(mass * 0.04 * 0.04 / 6.0);
  return "<robot name='slider'><link name='base'/><link name='tool'><inertial><mass value='" +
         std::to_string(mass) + "'/><inertia ixx='" + inertia + "' iyy='" + inertia + "' izz='" +
         inertia +
         "' ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry><box size='0.04 0.04 0.04'/>"
         "</geometry></collision></link><joint name='slide' type='prismatic'><parent link='base'/>"
         "<child link='tool'/><axis xyz='" +
         axis + "'/><limit lower='-2' upper='2' effort='" + std::to_string(effort) +
         "' velocity='100'/></joint></robot>";
}

}  // namespace pedicel::app
